// What servers before this one have lost, over HTTP:
//   GET    /api/lost          the list
//   DELETE /api/lost/NUMBER   one was noticed; it is shown no more
//
// Threads  any.
#pragma once

#include <vector>

#include "apps/gsv/lost/lost_simulations.h"
#include "gsv/gateway/http/route.h"

namespace gsv::app {

// `lost` outlives the handlers.
std::vector<gateway::Route> LostRoutes(LostSimulations& lost);

}  // namespace gsv::app
