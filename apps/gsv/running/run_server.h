// The server side of trials/prepared_runs.h. This process forks for each run, so that a run starts
// with the program linked and its files read.
#pragma once

#include "apps/gsv/process/signals.h"

namespace gsv::app {

// Reads requests from stdin, one JSON object per line:
//   {"arguments": [those of `gsv run`], "stdout": FILE, "stderr": FILE}
// and answers each request on stdout, after the run, with a line "exit code N" or "signal N". It
// executes one run at a time. Returns the exit code when stdin ends, or after a signal that ends
// the program; then it ends the run first.
//
// A run is a child process, so its crash ends nothing else. The calling process must have only one
// thread.
int ServeRuns(Signals& signals);

}  // namespace gsv::app
