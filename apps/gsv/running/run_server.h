// The run server of `gsv test` and campaigns (see trials/prepared_runs.h). It forks a process for
// each run, so that the run starts with the program linked and the files read.
#pragma once

#include "apps/gsv/process/signals.h"

namespace gsv::app {

// Reads requests from stdin, one JSON object per line:
//   {"arguments": [arguments of `gsv run`], "stdout": FILE, "stderr": FILE}
// and answers each request on stdout, after the run, with a line "exit code N" or "signal N". It
// executes one run at a time. When stdin ends, or after a signal that ends the program, this
// function ends the current run and returns the exit code of the program.
//
// A run is a child process, so its crash ends nothing else. The calling process must have only one
// thread.
int ServeRuns(Signals& signals);

}  // namespace gsv::app
