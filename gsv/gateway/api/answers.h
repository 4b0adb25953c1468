// Responses that the APIs of simulations and recordings share.
#pragma once

#include <functional>
#include <string>

#include "gsv/base/error.h"
#include "gsv/gateway/foxglove/shared_bytes.h"
#include "gsv/gateway/http/route.h"

namespace gsv::gateway {

// The GLB of a model, or 304 if the client has it. Models never change, so that browsers may cache
// them.
Response ModelAnswer(const Request& request, const std::string& id,
                     const base::Result<SharedBytes>& glb);

}  // namespace gsv::gateway
