// Sends HTTP requests to another instance.
#pragma once

#include <chrono>

#include "gsv/gateway/http/http.h"
#include "gsv/gateway/upstream/address.h"

namespace gsv::gateway::upstream {

// Forwards `request` and waits for the response, at most `limit`. Returns responses of any status.
// Fails with kUnavailable or kTimeout if there is no response.
base::Result<Response> Fetch(const Address& address, const Request& request,
                             std::chrono::milliseconds limit);

}  // namespace gsv::gateway::upstream
