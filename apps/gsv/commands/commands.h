// The subcommands of gsv. Each function adds the subcommands that the comment beside it lists.
// A function without a comment adds the subcommand in its name, such as `run` for AddRunCommand().
// The callback of a subcommand sets the exit code.
//
// AddCheckCommands() creates `world` and `model`, and AddRecordingCommands() creates `rec`. Call
// these two before the functions that add subcommands to `world`, `model` and `rec`.
#pragma once

#include "apps/gsv/process/signals.h"

namespace CLI {
class App;
}

namespace gsv::app {

// The objects that the functions below use.
struct CommandLine {
  CLI::App& app;     // the command to which subcommands are added
  Signals& signals;  // the signals that end the program
  int& exit_code;    // exit code of the program; the executed subcommand sets it
};

void AddRunCommand(const CommandLine& line);
void AddCampaignCommand(const CommandLine& line);
void AddCertificatesCommand(const CommandLine& line);
void AddServeCommand(const CommandLine& line);
void AddBrokerCommands(const CommandLine& line);  // broker, offers, types, links
void AddCheckCommands(const CommandLine& line);   // world check, model check
void AddDoctorCommand(const CommandLine& line);
void AddDrawCommand(const CommandLine& line);        // world draw
void AddConvertCommand(const CommandLine& line);     // model convert
void AddMapCommands(const CommandLine& line);        // world from-map, world to-map
void AddSaveCommand(const CommandLine& line);        // world save
void AddRecordingCommands(const CommandLine& line);  // rec, replay
void AddRecordCommands(const CommandLine& line);     // rec start, rec stop
void AddSnapshotCommand(const CommandLine& line);
void AddFilmCommand(const CommandLine& line);
void AddCompareCommands(const CommandLine& line);  // compare, fit
void AddControlCommands(const CommandLine& line);  // ps, and the commands that control a simulation
void AddBenchCommands(const CommandLine& line);    // bench
void AddTestCommand(const CommandLine& line);
void AddListCommand(const CommandLine& line);
void AddCompletionCommand(const CommandLine& line);
void AddViewCommand(const CommandLine& line);
void AddRos2Commands(const CommandLine& line);  // ros2 topics, nodes, echo, hz

}  // namespace gsv::app
