// Parses the target of an HTTP request (RFC 3986, sections 3.3 and 3.4).
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "gsv/base/error.h"

namespace gsv::gateway {

// A parsed target. For example, "/api/simulations/a%20b?x=1" has the segments {"api",
// "simulations", "a b"} and the query {"x": "1"}. Segments may
// contain any bytes, also '/' and "..", so code that uses them as file names must check them.
struct Target {
  std::vector<std::string> segments;  // "/" has no segments; a '/' at the end adds none
  std::map<std::string, std::string> query;
};

// Fails if the target does not begin with '/', is too long, or has a malformed escape.
base::Result<Target> ParseTarget(std::string_view target);

// Escapes one segment or query value: all characters except unreserved ones become %XX.
std::string Escape(std::string_view text);

}  // namespace gsv::gateway
