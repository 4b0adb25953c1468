// Serves the requests of the viewer's broker page over HTTP:
//   GET /api/broker/types   the service types
//   GET /api/broker/offers?type=&constraint=&preference=
//                           offers of a type: matches, and for the others the term that failed
//   GET /api/broker/links   the links, and whether they answer
//
// Threads  any.
#pragma once

#include <string>
#include <vector>

#include <omniORB4/CORBA.h>

#include "gsv/gateway/http/route.h"

namespace gsv::app {

std::vector<gateway::Route> BrokerRoutes(CORBA::ORB_ptr orb, const std::string& broker);

}  // namespace gsv::app
