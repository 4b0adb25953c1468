// Serves the requests of the viewer's broker page over HTTP:
//   GET /api/broker/types   the service types
//   GET /api/broker/offers?type=&constraint=&preference=
//                           the offers of a type: those that match the constraint, and for each
//                           other offer the value of each term of the constraint
//   GET /api/broker/links   the links, and whether their targets respond
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
