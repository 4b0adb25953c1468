// Routes for images of a simulation or a replay that the server draws: PREFIX/view.jpg,
// PREFIX/view.png and PREFIX/view.mjpeg. docs/viewer.md and docs/api.yaml describe the parameters.
//
// Errors  400 for an invalid parameter, 404 for an unknown robot or camera, 503 if too many views
//         are drawn. The body of each such response has an error message.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "gsv/gateway/drawing/view_drawer.h"
#include "gsv/gateway/http/route.h"

namespace gsv::gateway::drawing {

// The world that a request refers to.
struct ViewedWorld {
  std::string name;                    // unique in this server
  std::weak_ptr<const void> identity;  // see ViewDrawer::SetSource()
  ViewDrawer::MakeSource make;         // makes the source of the world's states
};
// Returns the world that a request names in its path.
using FindWorld = std::function<base::Result<ViewedWorld>(const Request&)>;

// The parameters in the query of a request.
struct ViewQuery {
  ViewRequest view;
  std::optional<std::uint64_t> after;  // number of the newest image that the client has
  double frames_a_second = 15;         // maximum rate of images, Hz
};
// Parses the parameters of the query. `is_stream` is true for view.mjpeg.
base::Result<ViewQuery> ParseViewQuery(const Target& target, bool is_stream);

// Returns the routes. `drawer` must outlive them. The server's thread calls `find`, which must
// return at once.
std::vector<Route> ViewRoutes(const std::string& prefix, ViewDrawer& drawer, const FindWorld& find);

}  // namespace gsv::gateway::drawing
