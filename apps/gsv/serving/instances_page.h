// What the viewer's page "Join" asks, over HTTP:
//   GET /api/instances   every gsv that the broker knows, and its simulations
//
// Threads  any. One question is put to the others at a time; whoever asks meanwhile gets the last
//          answer.
#pragma once

#include <string>
#include <vector>

#include <omniORB4/CORBA.h>

#include "gsv/gateway/http/route.h"

namespace gsv::app {

// `place` is this program's own "host:pid".
std::vector<gateway::Route> InstancesRoutes(CORBA::ORB_ptr orb, const std::string& broker,
                                            const std::string& place);

}  // namespace gsv::app
