// The description of the HTTP API, docs/api.yaml, from the time of the build.
#pragma once

#include <string_view>

#include "gsv/gateway/http/route.h"

namespace gsv::gateway {

std::string_view OpenApiText();

// GET /api/openapi.yaml
Route OpenApiRoute();

}  // namespace gsv::gateway
