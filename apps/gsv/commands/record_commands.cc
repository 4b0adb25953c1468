// Switches the recording of simulations in other processes on and off.
#include <cstdio>
#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>

#include "apps/gsv/commands/commands.h"
#include "apps/gsv/exit_code.h"
#include "apps/gsv/serving/remote_simulations.h"
#include "gsv/orb/errors.h"

namespace gsv::app {
namespace {

struct RecordArguments {
  Selection selection;
  std::string file;
};

int StartRecording(const RecordArguments& arguments) {
  const auto simulation = FindOneSimulation(arguments.selection);
  if (!simulation) return Complain(simulation.error());
  // The other process may stand in another folder.
  std::error_code error;
  const std::string path = std::filesystem::absolute(arguments.file, error).string();
  const auto done = orb::Call(simulation->server.Describe(),
                              [&] { simulation->reference->start_recording(path.c_str()); });
  if (!done) return Complain(done.error());
  std::printf("%s is recorded to %s\n", simulation->status.name.c_str(), path.c_str());
  return kOk;
}

int StopRecording(const RecordArguments& arguments) {
  const auto simulation = FindOneSimulation(arguments.selection);
  if (!simulation) return Complain(simulation.error());
  const auto done =
      orb::Call(simulation->server.Describe(), [&] { simulation->reference->stop_recording(); });
  if (!done) return Complain(done.error());
  std::printf("%s is recorded no more\n", simulation->status.name.c_str());
  return kOk;
}

void AddSimulation(CLI::App& command, RecordArguments& arguments) {
  command.add_option("simulation", arguments.selection.simulation,
                     "its name; without it: the newest run's, or the only one there is");
  command
      .add_option("--broker", arguments.selection.broker,
                  "the broker to look at, corbaloc::1.2@HOST:PORT/TradingService; without it: "
                  "those of your own running gsv")
      ->envname("GSV_BROKER");
  command.add_option("--server", arguments.selection.server,
                     "only on this server: its name, its process number or HOST:PID");
}

}  // namespace

void AddRecordCommands(const CommandLine& line) {
  CLI::App* rec = line.app.get_subcommand("rec");

  CLI::App* start = rec->add_subcommand("start", "Begin to record a simulation that runs");
  auto start_arguments = std::make_shared<RecordArguments>();
  start
      ->add_option("file", start_arguments->file,
                   "where, on the simulation's machine: NAME.mcap is a bare file, NAME a folder "
                   "that rosbag2 opens")
      ->required();
  AddSimulation(*start, *start_arguments);
  start->callback([start_arguments, line] { line.exit_code = StartRecording(*start_arguments); });

  CLI::App* stop = rec->add_subcommand("stop", "End the recording of a simulation that runs on");
  auto stop_arguments = std::make_shared<RecordArguments>();
  AddSimulation(*stop, *stop_arguments);
  stop->callback([stop_arguments, line] { line.exit_code = StopRecording(*stop_arguments); });
}

}  // namespace gsv::app
