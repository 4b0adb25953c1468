#include <cstdio>
#include <map>
#include <set>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/gsv/commands/commands.h"
#include "apps/gsv/doctor/doctor.h"
#include "apps/gsv/doctor/exposure.h"
#include "apps/gsv/machine/installation.h"
#include "apps/gsv/machine/sandbox.h"
#include "apps/gsv/process/exit_code.h"
#include "apps/gsv/serving/limit_option.h"
#include "apps/gsv/simulations/sensor_types.h"
#include "gsv/base/counted.h"
#include "gsv/formats/sdf_reader.h"
#include "gsv/model/drive_choice.h"

namespace gsv::app {
namespace {

struct CheckArguments {
  std::string file;
  std::vector<std::string> model_path, sensor_plugins;
  formats::ReadLimits limits;
  Sandbox sandbox;
  std::int64_t sandbox_seconds = 0;  // 0 if there is no sandbox
  bool json = false;
  bool strict = false;
};

using Notes = std::vector<std::string>;

std::string Listed(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list.empty() ? "none" : list;
}

// Returns one note about the drive of the robot that has this model, and one note for each joint
// in <ros2_control>.
Notes RobotNotes(const std::shared_ptr<const model::Model>& model) {
  Notes notes;
  if (const auto robot = model::AsRobot(model, "")) {
    const bool is_guessed = (*robot)->drive->origin == model::DriveOrigin::kGuessed;
    notes.push_back("drive: " + model::DescribeDrive(**robot) +
                    (is_guessed ? "; override with --drive" : ""));
  }
  for (const model::ControlSystem& system : model->control_systems) {
    for (const model::JointInterfaces& joint : system.joints) {
      notes.push_back("ros2_control " + system.name + ": joint " + joint.joint +
                      ": command interfaces " + Listed(joint.command) + "; state interfaces " +
                      Listed(joint.state));
    }
  }
  return notes;
}

// If the same message occurs in many places of a file, the text output lists at most this number of
// places. The JSON output lists all places.
constexpr std::size_t kPlacesPrinted = 10;

void Print(const CheckArguments& arguments, const char* severity, const std::string& where,
           const std::string& message) {
  if (arguments.json) {
    const nlohmann::ordered_json line = {
        {"severity", severity}, {"where", where}, {"message", message}};
    std::printf("%s\n",
                line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
  } else {
    std::printf("%s: %s%s%s\n", severity, where.c_str(), where.empty() ? "" : ": ",
                message.c_str());
  }
}

const char* SeverityName(bool is_error) { return is_error ? "error" : "warning"; }

// Prints each problem once. Returns the exit code, which is 3 if there are errors.
int Report(const CheckArguments& arguments, const base::Problems& problems, const Notes& notes,
           const base::Status& read) {
  std::uint64_t errors = read ? 0 : 1;
  std::uint64_t warnings = 0;
  for (const std::string& note : notes) Print(arguments, "note", "", note);
  std::map<std::pair<bool, std::string>, std::set<std::string>> places;
  for (const base::Problem& problem : problems) {
    const bool is_error = problem.severity == base::Problem::Severity::kError || arguments.strict;
    auto& of_message = places[{is_error, problem.message}];
    if (!of_message.insert(problem.where).second) continue;
    ++(is_error ? errors : warnings);
    if (arguments.json || of_message.size() <= kPlacesPrinted) {
      Print(arguments, SeverityName(is_error), problem.where, problem.message);
    }
  }
  for (const auto& [what, where] : places) {
    if (arguments.json || where.size() <= kPlacesPrinted) continue;
    Print(arguments, SeverityName(what.first),
          std::to_string(where.size() - kPlacesPrinted) + " more places (--json lists them)",
          what.second);
  }
  if (!read) Print(arguments, "error", read.error().where, read.error().message);
  if (!arguments.json) {
    std::printf("%s, %s\n", base::Counted(errors, "error").c_str(),
                base::Counted(warnings, "warning").c_str());
  }
  return errors > 0 ? kBadModel : kOk;
}

template <typename Read>
void AddCheck(const CommandLine& line, const char* group, const char* what, Read read) {
  CLI::App* parent = line.app.add_subcommand(group, std::string("Check ") + what);
  parent->require_subcommand(1);
  CLI::App* command = parent->add_subcommand("check", std::string("Print all problems of ") + what);
  auto arguments = std::make_shared<CheckArguments>();
  command->add_option("file", arguments->file, std::string("file, folder or name of the ") + group)
      ->required();
  command->add_option("--model-path", arguments->model_path, "folder to search for models")
      ->type_name("FOLDER");
  AddSensorPluginOption(*command, arguments->sensor_plugins);
  AddLimitOption(*command, arguments->limits);
  command->add_flag("--json", arguments->json, "print one JSON object per line");
  command->add_flag("--strict", arguments->strict,
                    "treat warnings as errors, for example warnings about unsupported elements");
  // This option is only for TryToRead(), and is hidden in the help.
  command->add_option("--confined-memory", arguments->sandbox.memory_bytes)->group("");
  command->add_option("--confined-time", arguments->sandbox_seconds)->group("");
  command->callback([arguments, line, read] {
    if (arguments->sandbox_seconds > 0) {
      arguments->sandbox.processor_time = std::chrono::seconds(arguments->sandbox_seconds);
      if (const auto confined = EnterSandbox(arguments->sandbox); !confined) {
        line.exit_code = PrintError(confined.error());
        return;
      }
    }
    SensorTypeOptions sensors;
    sensors.plugins.assign(arguments->sensor_plugins.begin(), arguments->sensor_plugins.end());
    auto types = MakeSensorTypes(
        sensors, base::Fail(base::ErrorCode::kUnavailable, "a check renders no images"));
    if (!types) {
      line.exit_code = PrintError(types.error());
      return;
    }
    formats::ReadOptions options;
    options.check_rules = true;
    options.check_sensor = CheckBy(*std::move(types));
    options.limits = arguments->limits;
    options.model_path.assign(arguments->model_path.begin(), arguments->model_path.end());
    formats::ModelLibrary library(std::move(options));
    base::Problems problems = CheckModelPath(arguments->model_path);
    Notes notes;
    const base::Status status = read(library, arguments->file, problems, notes);
    line.exit_code = Report(*arguments, problems, notes, status);
  });
}

}  // namespace

void AddCheckCommands(const CommandLine& line) {
  AddCheck(line, "world", "a world",
           [](formats::ModelLibrary& library, const std::string& file, base::Problems& problems,
              Notes&) {
             const auto found = FindWorld(file);
             if (!found) return base::Status(base::Fail(found.error()));
             const auto world = library.ReadWorld(*found, problems);
             return world ? base::Status() : base::Fail(world.error());
           });
  AddCheck(line, "model", "a model",
           [](formats::ModelLibrary& library, const std::string& file, base::Problems& problems,
              Notes& notes) {
             const auto model = library.ReadModel(file, problems);
             if (!model) return base::Status(base::Fail(model.error()));
             notes = RobotNotes(*model);
             return base::Status();
           });
}

void AddDoctorCommand(const CommandLine& line) {
  struct DoctorArguments {
    std::string broker;
    bool security = false, json = false;
  };
  CLI::App* doctor = line.app.add_subcommand(
      "doctor", "Check this machine: cameras, system limits, ports and the broker");
  auto asked = std::make_shared<DoctorArguments>();
  CLI::Option* security =
      doctor->add_flag("--security", asked->security,
                       "list the ports of running gsv programs, and who can reach them");
  doctor->add_flag("--json", asked->json, "print one JSON object per program; only with --security")
      ->needs(security);
  doctor->add_option("--broker", asked->broker, "broker to check: it must respond")
      ->type_name("ADDRESS")
      ->envname("GSV_BROKER");
  doctor->callback([asked, line] {
    line.exit_code = asked->security ? PrintExposure(asked->json) : Doctor(asked->broker);
  });
}

}  // namespace gsv::app
