// ViewersApi is the part of the HTTP API about viewers and control.
//
// Threads  any.
#pragma once

#include <string>
#include <vector>

#include "gsv/gateway/access/viewer_registry.h"
#include "gsv/gateway/http/route.h"

namespace gsv::gateway::access {

// Returns the viewers as in GET /api/viewers, without `you` if it is 0.
std::string ViewerListJson(const ViewerRegistry::ViewerList& standing);

// The part of the HTTP API about viewers and control.
class ViewersApi {
 public:
  // The handlers are valid during the lifetime of this object.
  std::vector<Route> Routes();

  // Returns an error with the reason if this viewer may not control the simulation now.
  base::Status CheckControl(const std::string& viewer, const std::string& simulation) {
    return registry_.CheckControl(viewer, simulation, std::chrono::steady_clock::now());
  }

  ViewerRegistry& registry() { return registry_; }

 private:
  // Registers a viewer.
  Response Enter(const Request& request);
  // Changes the name of a viewer or its selected simulation.
  base::Status Change(const Request& request);
  // Removes a viewer.
  base::Status Leave(const Request& request);
  // {"wants": true} requests control. {"wants": false} releases it, or withdraws the request.
  base::Status SetControlRequest(const Request& request);
  // Grants or refuses the first request in the queue for control.
  base::Status AnswerFirst(const Request& request);
  // Responds with the list of viewers. `viewer` is the key of the calling viewer, or empty.
  Response ViewerList(const std::string& viewer);

  ViewerRegistry registry_;
};

}  // namespace gsv::gateway::access
