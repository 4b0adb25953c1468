// A route of a server: address, permission, thread pool and handler. A test compares all routes
// with docs/api.yaml.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/gateway/foxglove/hub.h"
#include "gsv/gateway/http/http.h"

namespace gsv::gateway {

// The permission that a request needs. Each permission includes the permissions before it.
enum class Permission { kNone, kWatch, kControl };

// The threads that a handler runs on. Commands may block (a reset calls behaviours), and must not
// delay viewers.
enum class Pool { kReaders, kCommanders };

// An address of the server, with its permission and its handler.
struct Route {
  using Handler = std::function<Response(const Request&)>;
  // Returns the hub that the WebSocket of a request joins.
  using FindHub = std::function<base::Result<std::shared_ptr<Hub>>(const Request&)>;

  std::string method;  // "GET" (also for HEAD), "POST", "PUT", "DELETE"
  // For example "/api/simulations/{name}/scene". A parameter is one segment, or its beginning, as
  // in "/api/models/{id}.glb". "{path...}" ends a pattern, and matches one or more segments.
  std::string pattern;
  Permission permission = Permission::kWatch;
  // Whether the request is refused while another viewer holds control of the simulation {name}. For
  // a WebSocket, this applies to the commands of its client, which also need Permission::kControl.
  // Connecting to the WebSocket needs only `permission`.
  bool needs_control = false;
  Pool pool = Pool::kReaders;
  Handler handler;
  std::string summary;  // as in docs/api.yaml

  // Whether the body is a file: larger and slower bodies are allowed, and a body is read only if
  // the client may send it.
  bool takes_file = false;
  // Returns the hub of WebSockets at this address; null if the address has no WebSockets.
  FindHub find_hub{};
  // Used instead of `handler` for responses that come later. The server's thread calls it, so it
  // must return at once.
  std::function<void(const Request&, const Respond&)> later{};
  // Whether the query may contain the token. A page that shows an image (<img>) cannot set headers.
  bool accepts_token_in_query = false;
};

// Returns a route for WebSockets. Plain requests are answered with 426.
Route SocketRoute(std::string pattern, bool needs_control, Route::FindHub find_hub,
                  std::string summary);

// Appends the routes `more` to `routes`.
void Append(std::vector<Route>& routes, std::vector<Route> more);

}  // namespace gsv::gateway
