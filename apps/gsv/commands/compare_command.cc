#include <cmath>
#include <cstdio>
#include <optional>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/gsv/commands/commands.h"
#include "apps/gsv/machine/installation.h"
#include "apps/gsv/process/exit_code.h"
#include "apps/gsv/process/option_values.h"
#include "gsv/base/atomic_file.h"
#include "gsv/formats/sdf_reader.h"
#include "gsv/reality/comparison.h"
#include "gsv/reality/logs/log_reader.h"

namespace gsv::app {
namespace {

using Json = nlohmann::ordered_json;

struct CompareArguments {
  std::string log, format, world, preset, plot;
  std::vector<std::string> parameters, model_path;
  std::vector<double> start;
  std::optional<double> mount_forward;
  reality::CompareOptions options;
  bool json = false;
};

// Parses a text such as "roughness=0.1". The value is a number, true, false or a text.
base::Status SetParameter(const std::string& text, model::Parameters& parameters) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "--set takes NAME=VALUE, such as roughness=0.1, found " + text);
  }
  const std::string name = text.substr(0, equals), value = text.substr(equals + 1);
  char* end = nullptr;
  const double number = std::strtod(value.c_str(), &end);
  if (value == "true" || value == "false") {
    parameters[name] = value == "true";
  } else if (!value.empty() && *end == '\0') {
    parameters[name] = number;
  } else {
    parameters[name] = value;
  }
  return {};
}

struct Read {
  reality::Log log;
  reality::CompareOptions options;
};

base::Result<Read> ReadAll(const CompareArguments& arguments) {
  Read read{{}, arguments.options};
  read.options.preset = arguments.preset;
  for (const std::string& text : arguments.parameters) {
    if (auto ok = SetParameter(text, read.options.parameters); !ok) return base::Fail(ok.error());
  }
  if (!arguments.start.empty()) {
    read.options.start = {0, arguments.start[0], arguments.start[1], arguments.start[2]};
  }
  base::Problems problems;
  std::string format = arguments.format;
  if (format.empty()) {
    auto guessed = reality::GuessLogFormat(arguments.log);
    if (!guessed) return base::Fail(guessed.error());
    format = *std::move(guessed);
    std::fprintf(stderr, "gsv: reading %s as %s; override with --as\n", arguments.log.c_str(),
                 format.c_str());
  }
  auto log = reality::ReadLog(arguments.log, format, problems);
  if (log && !arguments.world.empty()) {
    const auto found = FindWorld(arguments.world);
    if (!found) return base::Fail(found.error());
    formats::ReadOptions options;
    options.model_path.assign(arguments.model_path.begin(), arguments.model_path.end());
    formats::ModelLibrary library(std::move(options));
    auto world = library.ReadWorld(*found, problems);
    if (!world) return base::Fail(world.error());
    read.options.world = *std::move(world);
  }
  for (const base::Problem& problem : problems) {
    std::fprintf(stderr, "gsv: warning: %s\n", problem.Sentence().c_str());
  }
  if (!log) return base::Fail(log.error());
  read.log = *std::move(log);
  if (arguments.mount_forward) read.log.sensor_forward = *arguments.mount_forward;
  return read;
}

void PrintWarning(const std::string& warning) {
  if (!warning.empty()) std::fprintf(stderr, "gsv: warning: %s\n", warning.c_str());
}

Json NumberOrNull(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

void Print(const reality::Comparison& comparison, bool json) {
  if (json) {
    Json rows = Json::array();
    for (const reality::Row& row : comparison.rows) {
      rows.push_back({{"device", row.device},
                      {"what", row.what},
                      {"unit", row.unit},
                      {"real", NumberOrNull(row.real)},
                      {"simulated", NumberOrNull(row.simulated)},
                      {"confidence", NumberOrNull(row.confidence)}});
    }
    Json printed{{"rows", rows}};
    if (!comparison.warning.empty()) printed["warning"] = comparison.warning;
    std::printf("%s\n", printed.dump().c_str());
    return;
  }
  std::printf("%-10s %-46s %10s %10s %10s\n", "device", "what", "real", "simulated", "± (95 %)");
  for (const reality::Row& row : comparison.rows) {
    const std::string what = row.what + (row.unit.empty() ? "" : " (" + row.unit + ")");
    const auto text = [](double value) {
      return std::isfinite(value) ? fmt::format("{:.4g}", value) : "-";
    };
    std::printf("%-10s %-46s %10s %10s %10.2g\n", row.device.c_str(), what.c_str(),
                text(row.real).c_str(), text(row.simulated).c_str(), row.confidence);
  }
}

int Compare(const CompareArguments& arguments) {
  const auto read = ReadAll(arguments);
  if (!read) return PrintError(read.error());
  const auto comparison = reality::Compare(read->log, read->options);
  if (!comparison) return PrintError(comparison.error());
  if (!arguments.plot.empty()) {
    const auto ok = base::WriteAtomically(arguments.plot, reality::ToSvg(*comparison),
                                          base::Durability::kProcess);
    if (!ok) return PrintError(ok.error());
  }
  Print(*comparison, arguments.json);
  PrintWarning(comparison->warning);
  return kOk;
}

int Fit(const CompareArguments& arguments) {
  const auto read = ReadAll(arguments);
  if (!read) return PrintError(read.error());
  const auto devices = reality::Fit(read->log, read->options);
  if (!devices) return PrintError(devices.error());
  for (const reality::FittedDevice& device : *devices) PrintWarning(device.warning);
  if (!arguments.json) {
    std::printf("%s", reality::ToSdf(*devices).c_str());
    return kOk;
  }
  Json list = Json::array();
  for (const reality::FittedDevice& device : *devices) {
    Json parameters = Json::object();
    for (const reality::FittedParameter& parameter : device.parameters) {
      parameters[parameter.name] = {{"value", NumberOrNull(parameter.value)},
                                    {"confidence", NumberOrNull(parameter.confidence)},
                                    {"unit", parameter.unit}};
    }
    list.push_back({{"type", device.type}, {"name", device.name}, {"parameters", parameters}});
    if (!device.warning.empty()) list.back()["warning"] = device.warning;
  }
  std::printf("%s\n", Json{{"devices", list}}.dump().c_str());
  return kOk;
}

std::shared_ptr<CompareArguments> AddOptions(CLI::App& command) {
  auto arguments = std::make_shared<CompareArguments>();
  command
      .add_option("log", arguments->log,
                  "main file of the log; the log's other files must be in the same folder")
      ->required()
      ->type_name("FILE");
  command
      .add_option("--as", arguments->format,
                  fmt::format("format of the log: {} (default: guessed)",
                              fmt::join(reality::LogFormats(), ", ")))
      ->type_name("FORMAT")
      ->check(OneOf(reality::LogFormats()));
  command
      .add_option("--world", arguments->world,
                  "world in which the robot drove (default: built from half of the log)")
      ->type_name("WORLD");
  command
      .add_flag("--update-world", arguments->options.update_world,
                "correct the walls of --world with half of the log's laser scans")
      ->needs(command.get_option("--world"));
  command
      .add_option("--start", arguments->start,
                  "pose of the first scan in the world: X Y YAW, m and rad (default: searched)\n"
                  "If the poses follow from the wheel readings only, this is the pose of the first "
                  "wheel reading (default: the measured pose, else 0 0 0).")
      ->expected(3)
      ->type_name("NUMBER");
  command.add_option("--preset", arguments->preset, "preset of the simulated device")
      ->type_name("NAME");
  command
      .add_option("--set", arguments->parameters, "parameter of the simulated device; repeatable")
      ->type_name("NAME=VALUE");
  command
      .add_option("--wheel-distance", arguments->options.wheel_distance,
                  "distance between the wheels, m, for a log with wheel encoders")
      ->capture_default_str()
      ->check(Between(1e-3, 100.0));
  command.add_option("--mount-height", arguments->options.height, "height of the scanner, m")
      ->capture_default_str()
      ->check(Between(-100.0, 100.0));
  command
      .add_option(
          "--mount-forward", arguments->mount_forward,
          "forward position of the scanner in the robot's frame, m (default: the log's, or 0)")
      ->check(Between(-100.0, 100.0));
  command.add_option("--seed", arguments->options.seed, "seed of the simulated devices")
      ->capture_default_str();
  command.add_option("--model-path", arguments->model_path, "folder to search for models")
      ->type_name("FOLDER");
  command.add_flag("--json", arguments->json, "print one JSON object");
  return arguments;
}

}  // namespace

void AddCompareCommands(const CommandLine& line) {
  CLI::App* compare = line.app.add_subcommand(
      "compare", "Compare a real robot's log with simulated devices at the same poses");
  auto compared = AddOptions(*compare);
  compare->add_option("--plot", compared->plot, "write the distributions as SVG to this file");
  compare->callback([compared, line] { line.exit_code = Compare(*compared); });

  CLI::App* fit =
      line.app.add_subcommand("fit", "Fit the parameters of simulated devices to a robot's log");
  auto fitted = AddOptions(*fit);
  fit->callback([fitted, line] { line.exit_code = Fit(*fitted); });
}

}  // namespace gsv::app
