// Commands that start and stop the recording of simulations in other processes.
#include <cstdio>
#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>

#include "apps/gsv/commands/commands.h"
#include "apps/gsv/commands/selection_options.h"
#include "apps/gsv/process/exit_code.h"
#include "gsv/orb/errors.h"

namespace gsv::app {
namespace {

struct RecordArguments {
  Selection selection;
  std::string file;
};

int StartRecording(const RecordArguments& arguments) {
  const auto simulation = FindOneSimulation(arguments.selection);
  if (!simulation) return PrintError(simulation.error());
  // The path is made absolute, because the process that records may have another working directory.
  std::error_code error;
  const std::string path = std::filesystem::absolute(arguments.file, error).string();
  const auto done = orb::Call(simulation->server.Describe(),
                              [&] { simulation->reference->start_recording(path.c_str()); });
  if (!done) return PrintError(done.error());
  std::printf("recording %s to %s\n", simulation->status.name.c_str(), path.c_str());
  return kOk;
}

int StopRecording(const RecordArguments& arguments) {
  const auto simulation = FindOneSimulation(arguments.selection);
  if (!simulation) return PrintError(simulation.error());
  const auto done =
      orb::Call(simulation->server.Describe(), [&] { simulation->reference->stop_recording(); });
  if (!done) return PrintError(done.error());
  std::printf("stopped recording %s\n", simulation->status.name.c_str());
  return kOk;
}

void AddRecordedSimulation(CLI::App& command, Selection& selection) {
  AddSimulationName(command, selection);
  AddInstanceOptions(command, selection);
}

}  // namespace

void AddRecordCommands(const CommandLine& line) {
  CLI::App* rec = line.app.get_subcommand("rec");

  CLI::App* start = rec->add_subcommand("start", "Start recording a running simulation");
  auto start_arguments = std::make_shared<RecordArguments>();
  start
      ->add_option("file", start_arguments->file,
                   "file NAME.mcap, or folder NAME for rosbag2, on the machine of the simulation")
      ->required();
  AddRecordedSimulation(*start, start_arguments->selection);
  start->callback([start_arguments, line] { line.exit_code = StartRecording(*start_arguments); });

  CLI::App* stop =
      rec->add_subcommand("stop", "Stop the recording of a simulation; the simulation continues");
  auto stop_arguments = std::make_shared<RecordArguments>();
  AddRecordedSimulation(*stop, stop_arguments->selection);
  stop->callback([stop_arguments, line] { line.exit_code = StopRecording(*stop_arguments); });
}

}  // namespace gsv::app
