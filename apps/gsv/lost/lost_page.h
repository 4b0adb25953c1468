// Serves crash reports of earlier servers over HTTP:
//   GET    /api/lost          the list
//   DELETE /api/lost/NUMBER   deletes the report with this number
//
// Threads  any.
#pragma once

#include <vector>

#include "apps/gsv/lost/lost_simulations.h"
#include "gsv/gateway/http/route.h"

namespace gsv::app {

// `lost` must outlive the handlers.
std::vector<gateway::Route> LostRoutes(LostSimulations& lost);

}  // namespace gsv::app
