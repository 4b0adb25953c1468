// The exit codes of every gsv command, and how errors become them.
#pragma once

#include "gsv/base/error.h"

namespace gsv::app {

enum ExitCode {
  kOk = 0,
  kAssertionFailed = 1,
  kUsage = 2,
  kBadModel = 3,
  kBehaviourFailed = 4,
  kInfrastructure = 5,
  kTimedOut = 124,
  kInterrupted = 130,
};

ExitCode ExitCodeFor(base::ErrorCode code);

// Prints the one sentence on stderr and gives the code to exit with.
int Complain(const base::Error& error);

}  // namespace gsv::app
