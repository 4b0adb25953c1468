#include "gsv/gateway/access/access_rule.h"

#include <arpa/inet.h>

#include <algorithm>
#include <cctype>

namespace gsv::gateway {
namespace {

std::string LowerCase(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower;
}

bool Contains(const std::vector<std::string>& list, const std::string& value) {
  return std::find(list.begin(), list.end(), value) != list.end();
}

// Quotes a text from an untrusted client, shortened so that a message can repeat it.
std::string Quoted(std::string_view text) { return "'" + std::string(text.substr(0, 100)) + "'"; }

}  // namespace

std::string Authority(std::string_view host, std::uint16_t port) {
  const bool is_ipv6 = host.find(':') != std::string_view::npos && host.front() != '[';
  const std::string name = is_ipv6 ? "[" + std::string(host) + "]" : std::string(host);
  return name + ":" + std::to_string(port);
}

AccessRule::AccessRule(std::string_view host, std::uint16_t port,
                       const std::vector<std::string>& more_hosts,
                       std::vector<std::string> more_origins, bool takes_addresses, bool is_secure)
    : scheme_(is_secure ? "https://" : "http://"),
      port_(port),
      usual_port_(is_secure ? 443 : 80),
      takes_addresses_(takes_addresses),
      origins_(std::move(more_origins)) {
  std::vector<std::string> names{"127.0.0.1", "localhost", "::1", std::string(host)};
  names.insert(names.end(), more_hosts.begin(), more_hosts.end());
  for (const std::string& name : names) {
    hosts_.push_back(LowerCase(Authority(name, port)));
    // Browsers omit the default port from the Host header, so the name alone is allowed as well.
    if (port == usual_port_) hosts_.push_back(hosts_.back().substr(0, hosts_.back().rfind(':')));
  }
  for (const std::string& allowed : hosts_) origins_.push_back(scheme_ + allowed);
}

bool AccessRule::IsAddress(const std::string& authority) const {
  const std::string ending = ":" + std::to_string(port_);
  std::string name = authority;
  if (name.ends_with(ending)) {
    name.resize(name.size() - ending.size());
  } else if (port_ != usual_port_) {
    return false;
  }
  if (name.starts_with('[') && name.ends_with(']')) name = name.substr(1, name.size() - 2);
  in6_addr parsed{};
  return inet_pton(AF_INET, name.c_str(), &parsed) == 1 ||
         inet_pton(AF_INET6, name.c_str(), &parsed) == 1;
}

base::Status AccessRule::Check(std::string_view host, std::string_view origin) const {
  const std::string asked = LowerCase(host);
  const bool is_address = takes_addresses_ && IsAddress(asked);
  if (!is_address && !Contains(hosts_, asked)) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "the Host header names " + Quoted(host) + "; open " + scheme_ +
                          hosts_.front() + "/ instead, or allow this name with --allow-host");
  }
  const bool is_own = is_address && LowerCase(origin) == scheme_ + asked;
  if (!origin.empty() && !is_own && !Contains(origins_, LowerCase(origin))) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "a page of " + Quoted(origin) + " may not use this server; open " + scheme_ +
                          hosts_.front() + "/ instead");
  }
  return {};
}

}  // namespace gsv::gateway
