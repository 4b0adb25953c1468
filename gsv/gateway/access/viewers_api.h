// The part of the HTTP API about viewers and control, see docs/api.yaml:
//   GET    /api/viewers              who is there, who holds control of what, who asks for it
//   POST   /api/viewers              {"name", "simulation"}: enter; gives the key to send as
//                                    Gsv-Viewer
//   POST   /api/viewers/me           {"name", "simulation"}: be called otherwise, look at another
//   DELETE /api/viewers/me           leave
//   POST   /api/viewers/me/control   {"wants"}: ask for control, or let go of it
//   POST   /api/viewers/me/answer    {"grants"}: to the first who asks
//
// Threads  any.
#pragma once

#include "gsv/gateway/access/control_desk.h"
#include "gsv/gateway/http/http.h"

namespace gsv::gateway::access {

// Who is there, as GET /api/viewers tells it; without `you`, which is 0.
std::string StandingJson(const ControlDesk::Standing& standing);

class ViewersApi {
 public:
  // `request.target` begins with "api", "viewers".
  Response Handle(const Request& request);

  // Why this viewer may not act now on that simulation.
  base::Status MayAct(const std::string& viewer, const std::string& simulation) {
    return desk_.MayAct(viewer, simulation, std::chrono::steady_clock::now());
  }

  ControlDesk& desk() { return desk_; }

 private:
  Response Enter(const Request& request);
  Response OfMe(const Request& request);
  base::Status Change(const Request& request);
  Response Standing(const std::string& viewer);

  ControlDesk desk_;
};

}  // namespace gsv::gateway::access
