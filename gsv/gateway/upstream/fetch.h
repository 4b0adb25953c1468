// One HTTP request to another instance.
#pragma once

#include <chrono>

#include "gsv/gateway/http/http.h"
#include "gsv/gateway/upstream/address.h"

namespace gsv::gateway::upstream {

// Passes `request` on and waits for the answer, whatever its status, at most `limit` in all.
// Blocks. Fails with kUnavailable or kTimeout when there is no answer.
base::Result<Response> Fetch(const Address& address, const Request& request,
                             std::chrono::milliseconds limit);

}  // namespace gsv::gateway::upstream
