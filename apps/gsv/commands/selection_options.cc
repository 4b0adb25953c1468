#include "apps/gsv/commands/selection_options.h"

namespace gsv::app {

void AddInstanceOptions(CLI::App& command, Selection& selection) {
  command
      .add_option(
          "--broker", selection.broker,
          "broker to search, corbaloc::1.2@HOST:PORT/TradingService (default: those of your "
          "own running gsv)")
      ->envname("GSV_BROKER");
  command.add_option("--server", selection.server,
                     "search only this server: its name, its process number or HOST:PID");
}

void AddSimulationName(CLI::App& command, Selection& selection) {
  command.add_option("simulation", selection.simulation,
                     "name of the simulation (default: the newest run's, or the only one)");
}

}  // namespace gsv::app
