// The exit codes of all gsv commands, and the mapping from errors to them.
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

// Prints the error as one sentence on stderr and returns its exit code.
int PrintError(const base::Error& error);

}  // namespace gsv::app
