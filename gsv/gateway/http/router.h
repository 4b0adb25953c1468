// Finds the route that a request is for.
//
// At each segment a literal is preferred to a parameter, and a parameter to "{path...}"; what was
// preferred is never given up again. So a path that begins like some route's is not matched by a
// "{path...}" at the root.
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

class Router {
 public:
  struct Match {
    const Route* route = nullptr;  // lives as long as the router; null: see NoRoute()
    // That the answer takes, whatever it is. Without a route: the least of all routes whose paths
    // begin with the same segment.
    Permission permission = Permission::kNone;
    std::string allow;  // the methods that the address takes: "GET, POST"; empty: it is no route's
    std::map<std::string, std::string, std::less<>> parameters;  // by name; without "{path...}"
  };

  // GSV_CHECK: patterns are well-formed, and no two routes have the same method and address.
  explicit Router(std::vector<Route> routes);
  ~Router();
  Router(const Router&) = delete;
  Router& operator=(const Router&) = delete;

  Match Find(std::string_view method, const Target& target) const;

  const std::vector<Route>& routes() const { return routes_; }

 private:
  struct Node;
  void Add(const Route& route);

  const std::vector<Route> routes_;
  const std::unique_ptr<Node> root_;
};

// The answer to a request that no route is for: 405 or 404.
Response NoRoute(const Router::Match& match);

}  // namespace gsv::gateway
