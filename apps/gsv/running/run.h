// One run of a simulation, from its start to its end.
#pragma once

#include "apps/gsv/process/signals.h"
#include "apps/gsv/running/run_options.h"

namespace gsv::app {

// Gives the exit code. Progress and the report go to stdout and stderr as `gsv run` prints them;
// `is_quiet` leaves out what is not a warning or an error.
base::Result<int> Run(const RunOptions& options, Signals& signals, bool is_quiet = false);

}  // namespace gsv::app
