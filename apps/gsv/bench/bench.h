// The benches of `gsv bench`: each adds its subcommand. All but the broker's run the step loop of
// `gsv run`.
#pragma once

#include <chrono>

#include "apps/gsv/commands.h"

namespace gsv::app {

void AddTypicalBench(const CommandLine& bench);
void AddLockstepBench(const CommandLine& bench);
void AddCrowdBench(const CommandLine& bench);
void AddBrokerBench(const CommandLine& bench);
void AddCameraBench(const CommandLine& bench);

inline double Seconds(std::chrono::nanoseconds duration) {
  return std::chrono::duration<double>(duration).count();
}
inline double Milliseconds(std::chrono::nanoseconds duration) {
  return std::chrono::duration<double, std::milli>(duration).count();
}

}  // namespace gsv::app
