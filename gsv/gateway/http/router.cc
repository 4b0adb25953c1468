#include "gsv/gateway/http/router.h"

#include <algorithm>
#include <utility>

#include "gsv/base/check.h"

namespace gsv::gateway {
namespace {

constexpr std::string_view kRest = "...}";

std::vector<std::string_view> SegmentsOf(std::string_view pattern) {
  GSV_CHECK(pattern.starts_with('/'));
  std::vector<std::string_view> segments;
  pattern.remove_prefix(1);
  while (!pattern.empty()) {
    const std::size_t end = std::min(pattern.find('/'), pattern.size());
    segments.push_back(pattern.substr(0, end));
    pattern.remove_prefix(std::min(end + 1, pattern.size()));
  }
  return segments;
}

}  // namespace

// A node of the tree of routes. The way from the root to a node stands for the first segments of a
// path. All routes at and below the node begin with these segments.
struct Router::Node {
  // Returns the child node for a segment of a pattern. Makes it if it does not exist.
  Node* Child(std::string_view segment_of_pattern);
  // Returns the child node that matches a segment of a path; null if there is none. If this is the
  // node of a parameter, stores the parameter's value in `match`.
  const Node* Next(const std::string& segment, Match& match) const;

  std::map<std::string, std::unique_ptr<Node>, std::less<>> literals;
  std::unique_ptr<Node> parameter, rest;
  std::string name, suffix;                 // of the parameter for which this node stands, or empty
  std::vector<const Route*> routes;         // routes that end here
  Permission least = Permission::kControl;  // the lowest permission of the routes at this node and
                                            // below
};

Router::Node* Router::Node::Child(std::string_view segment) {
  std::unique_ptr<Node>* child = nullptr;
  std::string_view found_name, found_suffix;
  if (!segment.starts_with('{')) {
    child = &literals[std::string(segment)];
  } else if (segment.ends_with(kRest)) {
    child = &rest;
  } else {
    const std::size_t end = segment.find('}');
    GSV_CHECK(end != std::string_view::npos);
    child = &parameter;
    found_name = segment.substr(1, end - 1);
    found_suffix = segment.substr(end + 1);
  }
  if (*child == nullptr) {
    *child = std::make_unique<Node>();
    (*child)->name = found_name;
    (*child)->suffix = found_suffix;
  }
  GSV_CHECK((*child)->name == found_name && (*child)->suffix == found_suffix);
  return child->get();
}

const Router::Node* Router::Node::Next(const std::string& segment, Match& match) const {
  if (const auto found = literals.find(segment); found != literals.end()) {
    return found->second.get();
  }
  if (parameter == nullptr || !segment.ends_with(parameter->suffix)) return rest.get();
  match.parameters[parameter->name] = segment.substr(0, segment.size() - parameter->suffix.size());
  return parameter.get();
}

Router::Router(std::vector<Route> routes)
    : routes_(std::move(routes)), root_(std::make_unique<Node>()) {
  for (const Route& route : routes_) Add(route);
}

Router::~Router() = default;

void Router::Add(const Route& route) {
  GSV_CHECK(route.handler != nullptr || route.later != nullptr);
  Node* node = root_.get();
  bool names_simulation = false, has_ended = false;
  for (const std::string_view segment : SegmentsOf(route.pattern)) {
    GSV_CHECK(!has_ended);
    has_ended = segment.ends_with(kRest);
    names_simulation = names_simulation || segment == "{name}";
    node->least = std::min(node->least, route.permission);
    node = node->Child(segment);
  }
  GSV_CHECK(!route.needs_control || route.find_hub != nullptr || names_simulation);
  node->least = std::min(node->least, route.permission);
  for (const Route* other : node->routes) GSV_CHECK(other->method != route.method);
  node->routes.push_back(&route);
}

Router::Match Router::Find(std::string_view method, const Target& target) const {
  Match match;
  match.permission = root_->least;
  const Node* node = root_.get();
  // The node of the last "{path...}" that could match on the way, apart from one at the root, and
  // the parameters up to this node. This node is used if no other route matches the request.
  const Node* rest = nullptr;
  auto parameters_of_rest = match.parameters;
  for (const std::string& segment : target.segments) {
    const Node* const parent = node;
    if (parent != root_.get() && parent->rest != nullptr) {
      rest = parent->rest.get();
      parameters_of_rest = match.parameters;
    }
    node = parent->Next(segment, match);
    if (node == nullptr) break;
    if (parent == root_.get()) match.permission = node->least;
    if (node == parent->rest.get()) break;
  }
  for (const Node* const end : {node, node == rest ? nullptr : rest}) {
    if (end == nullptr || match.route != nullptr) continue;
    for (const Route* route : end->routes) {
      match.allow += (match.allow.empty() ? "" : ", ") + route->method;
      if (route->method != method) continue;
      match.route = route;
      match.permission = route->permission;
      if (end == rest) match.parameters = parameters_of_rest;
    }
  }
  return match;
}

Response NoRoute(const Router::Match& match) {
  if (!match.allow.empty()) return MethodNotAllowed(match.allow);
  return ErrorResponse(404, "there is no resource at this address; /api/openapi.yaml lists all");
}

}  // namespace gsv::gateway
