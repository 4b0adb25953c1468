// Executes one run of a simulation, from start to end.
#pragma once

#include "apps/gsv/process/signals.h"
#include "apps/gsv/running/run_options.h"

namespace gsv::app {

// Runs the simulation and returns the exit code. Prints progress and the report to stdout and
// stderr like `gsv run`. If `is_quiet` is true, it prints only warnings and errors.
base::Result<int> Run(const RunOptions& options, Signals& signals, bool is_quiet = false);

}  // namespace gsv::app
