// A Router finds the route of a request by its method and path.
//
// At each segment of a path, a literal is preferred to a parameter, and a parameter to "{path...}".
// If the way chosen so leads to no route, the last "{path...}" on the way matches, but not one at
// the root. So a wrong address below /api is an error, and not a file of a "{path...}" at the root.
//
// Threads  const members may run concurrently.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "gsv/gateway/http/route.h"

namespace gsv::gateway {

// Finds the route of a request.
class Router {
 public:
  // The result of Find().
  struct Match {
    const Route* route = nullptr;  // valid during the lifetime of the router; null: see NoRoute()
    // The permission that a client needs to get the answer. If there is no route, it is the lowest
    // permission of all routes whose patterns begin with the same segment.
    Permission permission = Permission::kNone;
    // The methods of the address, such as "GET, POST"; empty if no route has this address.
    std::string allow;
    // Values of the pattern's parameters by name, except "{path...}".
    std::map<std::string, std::string, std::less<>> parameters;
  };

  // Patterns must be well-formed, and no two routes may have the same method and address
  // (GSV_CHECK).
  explicit Router(std::vector<Route> routes);
  ~Router();
  Router(const Router&) = delete;
  Router& operator=(const Router&) = delete;

  // Finds the route of a request. If there is none, `route` of the result is null.
  Match Find(std::string_view method, const Target& target) const;

  const std::vector<Route>& routes() const { return routes_; }

 private:
  // A node of the tree of patterns: the routes that begin with the same segments.
  struct Node;
  // Adds the pattern of a route to the tree.
  void Add(const Route& route);

  const std::vector<Route> routes_;
  const std::unique_ptr<Node> root_;  // the tree of patterns
};

// Returns the response to a request without a route: 405 or 404.
Response NoRoute(const Router::Match& match);

}  // namespace gsv::gateway
