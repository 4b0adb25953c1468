// One run of a simulation, from its start to its end.
#pragma once

#include "apps/gsv/commands/run_options.h"
#include "apps/gsv/signals.h"

namespace gsv::app {

// Gives the exit code. Progress and the report go to stdout and stderr as `gsv run` prints them;
// `is_quiet` leaves out what is not a warning or an error.
base::Result<int> Run(const RunOptions& options, Signals& signals, bool is_quiet = false);

}  // namespace gsv::app
