// Responses that the APIs of simulations and recordings share.
#pragma once

#include <functional>
#include <string>

#include "gsv/base/error.h"
#include "gsv/gateway/foxglove/shared_bytes.h"
#include "gsv/gateway/http/route.h"

namespace gsv::gateway {

// Returns the GLB of a model, or status 304 if the client has it. Browsers may cache it, because
// the model of an identifier never changes.
Response ModelAnswer(const Request& request, const std::string& id,
                     const base::Result<SharedBytes>& glb);

}  // namespace gsv::gateway
