// Runs what a recording of `gsv run` tells of once more, and compares.
#pragma once

#include <string>

#include "apps/gsv/process/signals.h"
#include "gsv/base/error.h"

namespace gsv::app {

struct ResimulationOptions {
  std::string file;
  std::string broker;     // empty: one of its own
  bool commands = false;  // the recorded ones instead of live behaviours
  bool json = false;
};

// Lockstep, from the recorded command and its folder, to the recorded end. Compares all topics, or
// how bodies moved if the robots get recorded commands (nobody then asks for pictures or mounts
// sensors). Prints where the two first differ; the exit code is 1 if they do. kInvalidArgument when
// the recording does not say how it was made.
base::Result<int> Resimulate(const ResimulationOptions& options, Signals& signals);

}  // namespace gsv::app
