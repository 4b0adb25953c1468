// The exit codes of all gsv commands, and the mapping from errors to them.
#pragma once

#include "gsv/base/error.h"

namespace gsv::app {

enum ExitCode {
  kOk = 0,
  kAssertionFailed = 1,  // an expectation or a comparison failed
  kUsage = 2,            // wrong arguments
  kBadModel = 3,         // a missing or invalid file
  kBehaviourFailed = 4,  // a behaviour failed
  kInfrastructure = 5,   // a broker, disk, renderer or other resource failed
  kTimedOut = 124,       // a limit of wall-clock time has passed
  kInterrupted = 130,    // a signal ended the program
};

ExitCode ExitCodeFor(base::ErrorCode code);

// Prints the error as one sentence on stderr and returns its exit code.
int PrintError(const base::Error& error);

}  // namespace gsv::app
