// One run of a simulation, from start to end.
#pragma once

#include "apps/gsv/process/signals.h"
#include "apps/gsv/running/run_options.h"

namespace gsv::app {

// Returns the exit code. Prints progress and the report to stdout and stderr like `gsv run`;
// `is_quiet` leaves out everything except warnings and errors.
base::Result<int> Run(const RunOptions& options, Signals& signals, bool is_quiet = false);

}  // namespace gsv::app
