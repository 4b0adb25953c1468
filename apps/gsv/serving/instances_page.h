// Serves the request of the viewer's page "Join" over HTTP:
//   GET /api/instances   all gsv processes at the broker, with their simulations
//
// Threads  any. One query of the instances runs at a time. Other requests during that time get the
//          last answer.
#pragma once

#include <string>
#include <vector>

#include <omniORB4/CORBA.h>

#include "gsv/gateway/http/route.h"

namespace gsv::app {

// `place` is this program's "host:pid".
std::vector<gateway::Route> InstancesRoutes(CORBA::ORB_ptr orb, const std::string& broker,
                                            const std::string& place);

}  // namespace gsv::app
