#include "apps/gsv/commands/selection_options.h"

namespace gsv::app {

void AddInstanceOptions(CLI::App& command, Selection& selection) {
  command
      .add_option("--broker", selection.broker,
                  "the broker to look at, corbaloc::1.2@HOST:PORT/TradingService; without it: "
                  "those of your own running gsv")
      ->envname("GSV_BROKER");
  command.add_option("--server", selection.server,
                     "only on this server: its name, its process number or HOST:PID");
}

void AddSimulationName(CLI::App& command, Selection& selection) {
  command.add_option("simulation", selection.simulation,
                     "its name; without it: the newest run's, or the only one there is");
}

}  // namespace gsv::app
