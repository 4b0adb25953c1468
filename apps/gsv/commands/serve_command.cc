#include <cstdio>

#include <CLI/CLI.hpp>

#include "apps/gsv/commands/commands.h"
#include "apps/gsv/machine/installation.h"
#include "apps/gsv/process/exit_code.h"
#include "apps/gsv/process/option_values.h"
#include "apps/gsv/serving/limit_option.h"
#include "apps/gsv/serving/runtime.h"
#include "apps/gsv/simulations/robot_drives.h"
#include "apps/gsv/simulations/sensor_types.h"

namespace gsv::app {
namespace {

struct ServeArguments {
  std::string broker, name = "gsv";
  std::vector<std::string> model_path, sensor_plugins, drives;
  formats::ReadLimits limits;
  ServerLimits server_limits;
  ViewerOptions web;
  Ros2Arguments ros2;
  int scenarios = 0;
  bool headless = false;
};

int Serve(const ServeArguments& arguments, Signals& signals) {
  for (const base::Problem& problem : CheckModelPath(arguments.model_path)) {
    std::fprintf(stderr, "gsv: warning: %s\n", problem.Sentence().c_str());
  }
  RuntimeOptions options;
  options.broker = arguments.broker;
  options.model_path.assign(arguments.model_path.begin(), arguments.model_path.end());
  options.sensors.plugins.assign(arguments.sensor_plugins.begin(), arguments.sensor_plugins.end());
  options.limits = arguments.limits;
  options.server_limits = arguments.server_limits;
  options.viewer = !arguments.headless;
  options.web = arguments.web;
  auto ros2 = ParseArguments(arguments.ros2);
  if (!ros2) return PrintError(ros2.error());
  options.ros2 = *std::move(ros2);
  options.noted_as = arguments.name;
  auto drives = ParseDrives(arguments.drives);
  if (!drives) return PrintError(drives.error());
  options.drives = *std::move(drives);
  auto runtime = Runtime::Start(options);
  if (!runtime) return PrintError(runtime.error());
  if (auto ok = (*runtime)->OfferService(arguments.name, arguments.scenarios); !ok)
    return PrintError(ok.error());
  if (!(*runtime)->viewer_url().empty())
    std::printf("viewer: %s\n", (*runtime)->viewer_url().c_str());
  std::printf("broker: %s\n", (*runtime)->broker().reference().c_str());
  if (Ros2Access* const access = (*runtime)->ros2()) {
    access->Follow();
    std::printf("ros2: %s\n", access->Description().c_str());
    if (const std::string why = access->Exposure(); !why.empty()) {
      std::fprintf(stderr, "gsv: warning: %s\n", why.c_str());
    }
  }
  std::fflush(stdout);
  signals.Wait();
  (*runtime)->EndSoon();
  return kOk;
}

}  // namespace

void AddServeCommand(const CommandLine& line) {
  CLI::App* command =
      line.app.add_subcommand("serve", "Serve simulations to viewers and applications");
  auto arguments = std::make_shared<ServeArguments>();
  constexpr const char* kServiceGroup = "Service";
  command->add_option("--name", arguments->name, "name of this server at the broker")
      ->capture_default_str()
      ->type_name("NAME")
      ->group(kServiceGroup);
  command->add_option("--model-path", arguments->model_path, "folder to search for models")
      ->type_name("FOLDER")
      ->group(kServiceGroup);
  command
      ->add_option("--drive", arguments->drives,
                   "drive of the robots of a model, such as husky=skid,radius=0.16")
      ->type_name("MODEL=KIND[,KEY=VALUE]")
      ->group(kServiceGroup);
  AddSensorPluginOption(*command, arguments->sensor_plugins)->group(kServiceGroup);
  command
      ->add_option(
          "--scenarios", arguments->scenarios,
          "number of campaign scenarios to run in parallel\n"
          "`gsv campaign run --broker` sends the scenarios. They use the behaviours that are "
          "installed on this machine.")
      ->check(Between(0, 256))
      ->capture_default_str()
      ->type_name("N")
      ->group(kServiceGroup);
  command->add_flag("--headless", arguments->headless, "start no viewer")->group(kViewerGroup);
  AddViewerOptions(*command, arguments->web);
  AddRecordingsOption(*command, arguments->web);
  AddRos2Options(*command, arguments->ros2);
  AddBrokerOption(*command, arguments->broker);
  AddLimitOption(*command, arguments->limits, arguments->server_limits)->group("Limits");
  command->callback([arguments, line] { line.exit_code = Serve(*arguments, line.signals); });
}

}  // namespace gsv::app
