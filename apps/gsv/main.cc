#include <cstdio>
#include <cstdlib>
#include <exception>

#include <CLI/CLI.hpp>

#include "apps/gsv/commands.h"
#include "apps/gsv/exit_code.h"
#include "gsv/base/log.h"
#include "gsv/simulation/simulation.h"

int main(int argc, char** argv) {
  using namespace gsv::app;
  Signals signals;
  int exit_code = kOk;
  CLI::App app(
      "GSV simulates robots whose behaviours are programs of their own, found through a broker.",
      "gsv");
  app.set_version_flag("--version", "gsv " GSV_VERSION);
  app.require_subcommand(1);
  app.failure_message(CLI::FailureMessage::simple);
  bool verbose = false;
  app.add_flag("-v,--verbose", verbose, "say more about what happens, on stderr");
  app.parse_complete_callback(
      [&] { gsv::base::InitLogging(verbose ? spdlog::level::debug : spdlog::level::warn); });
  const CommandLine line{app, signals, exit_code};
  AddRunCommand(line);
  AddServeCommand(line);
  AddBrokerCommands(line);
  AddCheckCommands(line);
  AddDrawCommand(line);
  AddRecordingCommands(line);
  AddRecordCommands(line);
  AddControlCommands(line);
  AddBenchCommands(line);
  AddTestCommand(line);
  AddCampaignCommand(line);
  AddViewCommand(line);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kOk : kUsage;
  } catch (const std::exception& exception) {
    return Complain({gsv::base::ErrorCode::kUnavailable, exception.what(), "unexpected"});
  }
  if (gsv::simulation::Simulation::LeftToThemselves() > 0) {
    // A behaviour is still at work on what a return from here would destroy.
    std::fflush(nullptr);
    std::_Exit(exit_code);
  }
  return exit_code;
}
