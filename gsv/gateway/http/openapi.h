// Serves the description of the HTTP API: docs/api.yaml as it was when gsv was built.
#pragma once

#include <string_view>

#include "gsv/gateway/http/route.h"

namespace gsv::gateway {

// The text of docs/api.yaml.
std::string_view OpenApiText();

// GET /api/openapi.yaml
Route OpenApiRoute();

}  // namespace gsv::gateway
