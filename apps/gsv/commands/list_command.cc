#include <cstdio>
#include <map>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/gsv/commands/commands.h"
#include "apps/gsv/machine/installation.h"
#include "apps/gsv/process/exit_code.h"
#include "apps/gsv/process/option_values.h"
#include "apps/gsv/serving/behaviour_launcher.h"
#include "apps/gsv/simulations/sensor_types.h"
#include "gsv/formats/files/resource_finder.h"

namespace gsv::app {
namespace {

struct ListArguments {
  std::string kind;
  std::vector<std::string> model_path, sensor_plugins;
  bool json = false;
};

base::Result<std::vector<std::string>> SensorTypes(const ListArguments& arguments) {
  SensorTypeOptions options;
  options.plugins.assign(arguments.sensor_plugins.begin(), arguments.sensor_plugins.end());
  const auto types = MakeSensorTypes(
      options, base::Fail(base::ErrorCode::kUnavailable, "nothing is drawn", "gsv list"));
  if (!types) return base::Fail(types.error());
  return (*types)->names();
}

base::Result<std::vector<std::string>> NamesOf(const ListArguments& arguments) {
  if (arguments.kind == "worlds") return BuiltInWorlds();
  if (arguments.kind == "behaviours") return BehaviourPrograms();
  if (arguments.kind == "sensors") return SensorTypes(arguments);
  return formats::ResourceFinder({arguments.model_path.begin(), arguments.model_path.end()})
      .ModelNames();
}

int List(const ListArguments& arguments) {
  for (const base::Problem& problem : CheckModelPath(arguments.model_path)) {
    std::fprintf(stderr, "gsv: warning: %s\n", problem.Sentence().c_str());
  }
  const auto names = NamesOf(arguments);
  if (!names) return PrintError(names.error());
  if (arguments.json) {
    std::puts(nlohmann::json(*names)
                  .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)
                  .c_str());
  } else {
    for (const std::string& name : *names) std::puts(name.c_str());
  }
  return kOk;
}

}  // namespace

void AddListCommand(const CommandLine& line) {
  CLI::App* command = line.app.add_subcommand(
      "list", "List the worlds, models, behaviours or sensor types of this installation");
  auto arguments = std::make_shared<ListArguments>();
  command
      ->add_option(
          "kind", arguments->kind,
          "kind of names to list\nThe models are those that gsv contains and those in the model "
          "path. The behaviours are the programs that gsv can start. `gsv offers` lists the "
          "behaviours that run.")
      ->required()
      ->check(OneOf({"worlds", "models", "behaviours", "sensors"}))
      ->type_name("worlds|models|behaviours|sensors");
  command->add_option("--model-path", arguments->model_path, "folder to search for models")
      ->type_name("FOLDER");
  AddSensorPluginOption(*command, arguments->sensor_plugins);
  command->add_flag("--json", arguments->json, "print one JSON array");
  command->callback([arguments, line] { line.exit_code = List(*arguments); });
}

}  // namespace gsv::app
