// Delays the remote calls of a behaviour program randomly, to test that results do not depend on
// when calls arrive. The delays are in the ORB's transport, before a request is sent and after a
// reply has arrived. GSV_FAULT_DELAY="seed=7,max_ms=20" enables them.
#pragma once

#include <chrono>
#include <cstdint>
#include <string_view>

#include "gsv/base/error.h"

namespace gsv::sdk {

// The parameters of the random delays.
struct FaultDelay {
  std::uint64_t seed = 0;
  std::chrono::milliseconds max{0};  // upper limit of each delay
};

// Parses the value of GSV_FAULT_DELAY. Returns kInvalidArgument with the expected form.
base::Result<FaultDelay> ParseFaultDelay(std::string_view text);

// The duration of the `n`th delay, uniform in [0, max).
std::chrono::nanoseconds NthDelay(const FaultDelay& fault, std::uint64_t n);

// Delays all later calls of this process. Call it once, after the ORB has started and before the
// first remote call.
void DelayCalls(const FaultDelay& fault);

// Delays the calling thread once, if DelayCalls() was called. Call it when data is exchanged by
// shared memory, because such an exchange does not use the ORB.
void DelayOnce();

// Calls DelayCalls() if GSV_FAULT_DELAY is set.
base::Status DelayCallsFromEnvironment();

}  // namespace gsv::sdk
