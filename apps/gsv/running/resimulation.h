// Repeats the recorded run of `gsv run`, and compares the results.
#pragma once

#include <string>

#include "apps/gsv/process/signals.h"
#include "gsv/base/error.h"

namespace gsv::app {

// The options of a repeated run.
struct ResimulationOptions {
  std::string file;       // the recording
  std::string broker;     // empty if the repeated run starts its own broker
  bool commands = false;  // whether recorded commands are used instead of live behaviours
  bool json = false;      // whether the result is printed as JSON
};

// Runs in lockstep, with the recorded command line and working directory, to the recorded end.
// Compares all topics. With recorded commands it compares only the motion of bodies, because no
// behaviour then requests images or mounts sensors. Prints the first difference, and returns exit
// code 1 if there is one. Returns kInvalidArgument if the recording has no command line.
base::Result<int> Resimulate(const ResimulationOptions& options, Signals& signals);

}  // namespace gsv::app
