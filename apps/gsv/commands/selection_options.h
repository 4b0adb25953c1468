// The options by which commands select a simulation in another process.
#pragma once

#include <CLI/CLI.hpp>

#include "apps/gsv/serving/remote_simulations.h"

namespace gsv::app {

// Adds --broker and --server. `selection` must outlive the command line.
void AddInstanceOptions(CLI::App& command, Selection& selection);
// Adds the simulation's name as the next argument.
void AddSimulationName(CLI::App& command, Selection& selection);

}  // namespace gsv::app
