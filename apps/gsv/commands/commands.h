// The subcommands of gsv. Each function adds one subcommand, whose callback sets the exit code.
#pragma once

#include "apps/gsv/process/signals.h"

namespace CLI {
class App;
}

namespace gsv::app {

struct CommandLine {
  CLI::App& app;
  Signals& signals;
  int& exit_code;
};

void AddRunCommand(const CommandLine& line);
void AddCampaignCommand(const CommandLine& line);
void AddCertificatesCommand(const CommandLine& line);
void AddServeCommand(const CommandLine& line);
void AddBrokerCommands(const CommandLine& line);  // broker, offers, types, links
void AddCheckCommands(const CommandLine& line);   // world check, model check, doctor
void AddDrawCommand(const CommandLine& line);     // world draw; after AddCheckCommands()
void AddConvertCommand(const CommandLine& line);  // model convert; after AddCheckCommands()
void AddMapCommands(const CommandLine& line);  // world from-map, to-map; after AddCheckCommands()
void AddSaveCommand(const CommandLine& line);  // world save; after AddCheckCommands()
void AddRecordingCommands(const CommandLine& line);  // rec, replay
void AddRecordCommands(const CommandLine& line);  // rec start, stop; after AddRecordingCommands()
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
