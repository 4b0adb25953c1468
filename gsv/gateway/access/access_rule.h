// Decides which clients may talk to a server on this machine: pages that it served itself, and
// programs.
//
// A page from any site may try to reach 127.0.0.1 (cross-site requests, WebSockets, DNS rebinding).
// The Host header has the name under which the browser reached the server, and the Origin header
// has the origin of the page. Browsers prevent pages from forging them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "gsv/base/error.h"

namespace gsv::gateway {

class AccessRule {
 public:
  // Always allowed are 127.0.0.1, localhost, [::1] and `host`, with `port`. `more_hosts` are
  // further names of this machine, without a port. `more_origins` are further origins as browsers
  // write them ("https://app.example.org"). `takes_addresses`: allow any IP address as Host, as no
  // DNS name can point to it. `is_secure`: pages are served by HTTPS, and only these are its own.
  AccessRule(std::string_view host, std::uint16_t port, const std::vector<std::string>& more_hosts,
             std::vector<std::string> more_origins, bool takes_addresses = false,
             bool is_secure = false);

  // Checks a request. `origin` is empty if there is no such header, as for programs other than
  // browsers.
  base::Status Check(std::string_view host, std::string_view origin) const;

 private:
  bool IsAddress(const std::string& authority) const;

  const std::string scheme_;  // "http://"
  const std::uint16_t port_, usual_port_;
  const bool takes_addresses_;
  std::vector<std::string> hosts_;
  std::vector<std::string> origins_;
};

// "127.0.0.1:80", "[::1]:80"
std::string Authority(std::string_view host, std::uint16_t port);

}  // namespace gsv::gateway
