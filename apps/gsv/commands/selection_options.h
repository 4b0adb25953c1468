// The options with which commands choose a simulation that runs in another process.
#pragma once

#include <CLI/CLI.hpp>

#include "apps/gsv/serving/remote_simulations.h"

namespace gsv::app {

// --broker and --server. `selection` outlives the command line.
void AddInstanceOptions(CLI::App& command, Selection& selection);
// The simulation's name, as the next argument.
void AddSimulationName(CLI::App& command, Selection& selection);

}  // namespace gsv::app
