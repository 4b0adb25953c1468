// The other side of trials/prepared_runs.h: a process that forks for each run, so that a run starts
// with the program linked and its files read.
#pragma once

#include "apps/gsv/process/signals.h"

namespace gsv::app {

// Reads requests from stdin, one JSON object a line:
//   {"arguments": [those of `gsv run`], "stdout": FILE, "stderr": FILE}
// and answers each on stdout, after the run, with a line: "exit code N" or "signal N". One run at a
// time. Returns the exit code when stdin ends or a signal that ends the program has come; then it
// ends the run first.
//
// A run is a child process: its crash ends nothing else. The calling process must have one thread.
int ServeRuns(Signals& signals);

}  // namespace gsv::app
