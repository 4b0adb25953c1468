// An AccessRule decides which clients may use this server: pages that the server itself served, and
// programs other than browsers.
//
// A page from any site may try to reach 127.0.0.1 (cross-site requests, WebSockets, DNS rebinding).
// The Host header has the name under which the browser reached the server, and the Origin header
// has the origin of the page. Browsers prevent pages from forging these two headers.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "gsv/base/error.h"

namespace gsv::gateway {

// Checks the Host and Origin headers of requests.
class AccessRule {
 public:
  // The hosts 127.0.0.1, localhost, [::1] and `host`, each with `port`, are always allowed.
  // `more_hosts` are further names of this machine, without a port. `more_origins` are further
  // origins in the form of the Origin header ("https://app.example.org"). `takes_addresses`: allow
  // any IP address in the Host header. This is safe, because DNS rebinding needs a name.
  // `is_secure`: the server uses HTTPS, so only https:// origins count as its own.
  AccessRule(std::string_view host, std::uint16_t port, const std::vector<std::string>& more_hosts,
             std::vector<std::string> more_origins, bool takes_addresses = false,
             bool is_secure = false);

  // Checks the Host and Origin headers of a request. `origin` is empty if there is no such header,
  // because only browsers send it.
  base::Status Check(std::string_view host, std::string_view origin) const;

 private:
  // Whether the Host header has an IP address with the server's port.
  bool IsAddress(const std::string& authority) const;

  const std::string scheme_;               // "http://"
  const std::uint16_t port_, usual_port_;  // the server's port, and the default port of its scheme
  const bool takes_addresses_;
  std::vector<std::string> hosts_;    // allowed Host headers
  std::vector<std::string> origins_;  // allowed Origin headers
};

// "127.0.0.1:80", "[::1]:80"
std::string Authority(std::string_view host, std::uint16_t port);

}  // namespace gsv::gateway
