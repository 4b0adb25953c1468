#include "apps/gsv/commands/selection_options.h"

namespace gsv::app {

void AddInstanceOptions(CLI::App& command, Selection& selection) {
  command
      .add_option("--broker", selection.broker,
                  "broker to search for simulations (default: those of your running instances)\n"
                  "The address has the form corbaloc::1.2@HOST:PORT/TradingService.")
      ->type_name("ADDRESS")
      ->envname("GSV_BROKER");
  command
      .add_option("--server", selection.server,
                  "search only this server: its name, its PID or HOST:PID")
      ->type_name("SERVER");
}

void AddSimulationName(CLI::App& command, Selection& selection) {
  command.add_option("simulation", selection.simulation,
                     "name of the simulation (default: that of your newest instance)");
}

}  // namespace gsv::app
