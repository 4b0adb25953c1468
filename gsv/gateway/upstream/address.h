// Where another instance's viewer is served.
#pragma once

#include <string>
#include <string_view>

#include "gsv/base/error.h"

namespace gsv::gateway::upstream {

struct Address {
  std::string host;     // a name or an address; IPv6 without brackets
  std::string port;     // digits
  std::string token{};  // that is shown there; empty: none

  std::string Authority() const;  // "host:port", "[::1]:port"
  std::string Url() const { return "http://" + Authority() + "/"; }
};

// From "http://host:port/", as gsv prints it. The port is 80 where it is left out.
base::Result<Address> ParseAddress(std::string_view url);

}  // namespace gsv::gateway::upstream
