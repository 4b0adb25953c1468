// A Router finds the route of a request by its method and path.
//
// At each segment, literals precede parameters, and parameters precede "{path...}", without
// backtracking. So a path that begins like another route is not matched by a "{path...}" at the
// root.
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
    // The permission that the answer requires. Without a route: the lowest permission of all routes
    // whose paths begin with the same segment.
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

  // Returns the route of a request, or its absence.
  Match Find(std::string_view method, const Target& target) const;

  const std::vector<Route>& routes() const { return routes_; }

 private:
  // A node of the tree of patterns: the routes that begin with the same segments.
  struct Node;
  // Adds the pattern of a route to the tree.
  void Add(const Route& route);

  const std::vector<Route> routes_;
  const std::unique_ptr<Node> root_;
};

// Returns the response to a request without a route: 405 or 404.
Response NoRoute(const Router::Match& match);

}  // namespace gsv::gateway
