// What servers before this one have lost, over HTTP:
//   GET    /api/lost          the list
//   DELETE /api/lost/NUMBER   one was noticed; it is shown no more
//
// Threads  any.
#pragma once

#include "apps/gsv/lost/lost_simulations.h"
#include "gsv/gateway/http/http.h"

namespace gsv::app {

gateway::Response AnswerOfLost(LostSimulations& lost, const gateway::Request& request);

}  // namespace gsv::app
