// Answers that the API of a simulation and that of a recording have in common.
#pragma once

#include <functional>
#include <string>

#include "gsv/base/error.h"
#include "gsv/gateway/foxglove/shared_bytes.h"
#include "gsv/gateway/http/http.h"

namespace gsv::gateway {

Response NoSuchAddress();

// To GET /api/models/ID.glb. `glb` tells a model's bytes by its identity; they never change, so
// that browsers may keep them.
Response ModelAnswer(const Request& request,
                     const std::function<base::Result<SharedBytes>(const std::string& id)>& glb);

}  // namespace gsv::gateway
