// Delays the remote calls of a behaviour program at random, to show that its results do not depend
// on when its calls arrive. It sits in the ORB's transport: before a request is sent and after a
// reply has come. The environment switches it on: GSV_FAULT_DELAY="seed=7,max_ms=20".
#pragma once

#include <chrono>
#include <cstdint>
#include <string_view>

#include "gsv/base/error.h"

namespace gsv::sdk {

struct FaultDelay {
  std::uint64_t seed = 0;
  std::chrono::milliseconds max{0};
};

// Errors  kInvalidArgument, saying what the text looks like.
base::Result<FaultDelay> ParseFaultDelay(std::string_view text);

// How long the `n`th delay takes: evenly spread over [0, max).
std::chrono::nanoseconds NthDelay(const FaultDelay& fault, std::uint64_t n);

// From now on, for all calls of this process. Once a process, after its ORB has started and before
// it calls anybody.
void DelayCalls(const FaultDelay& fault);

// Does so when GSV_FAULT_DELAY is set.
base::Status DelayCallsAsEnvironmentSays();

}  // namespace gsv::sdk
