// The address of another instance of gsv.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "gsv/base/error.h"

// Declared here, so that files with an address need not compile Boost.Asio.
namespace boost::asio::ssl {
class context;
}

namespace gsv::gateway::upstream {

// The address of another instance, and the credentials for it.
struct Address {
  std::string host;     // a name or an address; IPv6 without brackets
  std::string port;     // digits
  std::string token{};  // the token for the other instance; empty if there is none
  std::shared_ptr<boost::asio::ssl::context> tls{};  // trusted authorities, for https; null: http

  std::string Authority() const;  // "host:port", "[::1]:port"
  std::string Url() const { return (tls ? "https://" : "http://") + Authority() + "/"; }
};

// Parses "http://host:port/" or "https://host:port/", as gsv prints it. The default port is 80 or
// 443. `authority` is a PEM file with trusted certificates; if empty, the system's are used.
base::Result<Address> ParseAddress(std::string_view url, const std::string& authority = {});

}  // namespace gsv::gateway::upstream
