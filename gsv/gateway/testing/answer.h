// For tests: the response of a route, without checking permissions.
#pragma once

#include <utility>

#include "gsv/gateway/http/router.h"

namespace gsv::gateway::testing {

// Returns the response of the router to a request.
inline Response Answer(const Router& router, Request request) {
  Router::Match match = router.Find(request.method, request.target);
  if (match.route == nullptr) return NoRoute(match);
  request.parameters = std::move(match.parameters);
  return match.route->handler(request);
}

}  // namespace gsv::gateway::testing
