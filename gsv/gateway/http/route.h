// One address that a server answers: who may use it, where its handler runs, and what it answers.
// Every set of routes is such a list; the description of the API (docs/api.yaml) is held to it.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/gateway/foxglove/hub.h"
#include "gsv/gateway/http/http.h"

namespace gsv::gateway {

// What a request takes. Each permission includes those before it.
enum class Permission { kNone, kWatch, kControl };

// The threads that a handler runs on. Commands may block (a reset calls behaviours), and must not
// hold up viewers.
enum class Pool { kReaders, kCommanders };

struct Route {
  using Handler = std::function<Response(const Request&)>;
  using FindHub = std::function<base::Result<std::shared_ptr<Hub>>(const Request&)>;

  std::string method;  // "GET", which answers HEAD as well, "POST", "PUT", "DELETE"
  // "/api/simulations/{name}/scene". A parameter is one segment, or its beginning, as in
  // "/api/models/{id}.glb"; "{path...}" is the last part of a pattern: one or more segments.
  std::string pattern;
  Permission permission = Permission::kWatch;
  // Refused while another viewer holds control of the simulation {name}. Of a WebSocket: what its
  // client does is refused so, and takes Permission::kControl; to connect takes `permission` alone.
  bool needs_control = false;
  Pool pool = Pool::kReaders;
  Handler handler;
  std::string summary;  // as in docs/api.yaml

  // The body is a file: it may be larger and take longer than others, and is not read from clients
  // that may not send it.
  bool takes_file = false;
  // The hub that a WebSocket at this address joins; null: no WebSockets are served here.
  FindHub find_hub{};
};

// A route at which WebSockets are served; plain requests are answered with 426.
Route SocketRoute(std::string pattern, bool needs_control, Route::FindHub find_hub,
                  std::string summary);

void Append(std::vector<Route>& routes, std::vector<Route> more);

}  // namespace gsv::gateway
