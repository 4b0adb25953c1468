// The part of the HTTP API about viewers and control, see docs/api.yaml:
//   GET    /api/viewers              who is there, who holds control, who asks for it
//   POST   /api/viewers              {"name"}: enter; gives the key to send as Gsv-Viewer
//   POST   /api/viewers/me           {"name"}: be called otherwise
//   DELETE /api/viewers/me           leave
//   POST   /api/viewers/me/control   {"wants"}: ask for control, or let go of it
//   POST   /api/viewers/me/answer    {"grants"}: to the first who asks
//
// Threads  any.
#pragma once

#include "gsv/gateway/access/control_desk.h"
#include "gsv/gateway/http.h"

namespace gsv::gateway::access {

class ViewersApi {
 public:
  // `request.target` begins with "api", "viewers".
  Response Handle(const Request& request);

  // Why this viewer may not act now on what all see.
  base::Status MayAct(const std::string& viewer) {
    return desk_.MayAct(viewer, std::chrono::steady_clock::now());
  }

 private:
  Response Enter(const Request& request);
  Response OfMe(const Request& request);
  Response Standing(const std::string& viewer);

  ControlDesk desk_;
};

}  // namespace gsv::gateway::access
