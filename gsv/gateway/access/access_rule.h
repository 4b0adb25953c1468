// Who may talk to a server on this machine: pages that it served itself, and programs.
//
// A page from anywhere on the web may try to reach 127.0.0.1 (cross-site requests, WebSockets, DNS
// rebinding). The Host header tells under which name the browser believes to have reached us, the
// Origin header whose page asks; browsers let neither be forged.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "gsv/base/error.h"

namespace gsv::gateway {

class AccessRule {
 public:
  // Always allowed: 127.0.0.1, localhost, [::1] and `host`, with `port`. `more_hosts` are further
  // names of this machine, without a port; `more_origins` further origins as browsers write them
  // ("https://app.example.org"). `takes_addresses`: any address is allowed as well, as it stands
  // for no name that somebody could point here. `is_secure`: pages are served by HTTPS, and only
  // such pages are its own.
  AccessRule(std::string_view host, std::uint16_t port, const std::vector<std::string>& more_hosts,
             std::vector<std::string> more_origins, bool takes_addresses = false,
             bool is_secure = false);

  // `origin` is empty when there is no such header, as with programs other than browsers.
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
