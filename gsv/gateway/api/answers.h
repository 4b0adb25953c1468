// Answers that the API of a simulation and that of a recording have in common.
#pragma once

#include <functional>
#include <string>

#include "gsv/base/error.h"
#include "gsv/gateway/foxglove/shared_bytes.h"
#include "gsv/gateway/http/route.h"

namespace gsv::gateway {

// With a model's bytes, or where they are known already, without. A model's bytes never change, so
// browsers may keep them.
Response ModelAnswer(const Request& request, const std::string& id,
                     const base::Result<SharedBytes>& glb);

}  // namespace gsv::gateway
