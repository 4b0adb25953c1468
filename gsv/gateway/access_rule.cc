#include "gsv/gateway/access_rule.h"

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

// What a stranger sent, short enough to be repeated to them.
std::string Quoted(std::string_view text) { return "'" + std::string(text.substr(0, 100)) + "'"; }

}  // namespace

std::string Authority(std::string_view host, std::uint16_t port) {
  const bool is_ipv6 = host.find(':') != std::string_view::npos && host.front() != '[';
  const std::string name = is_ipv6 ? "[" + std::string(host) + "]" : std::string(host);
  return name + ":" + std::to_string(port);
}

AccessRule::AccessRule(std::string_view host, std::uint16_t port,
                       const std::vector<std::string>& more_hosts,
                       std::vector<std::string> more_origins)
    : origins_(std::move(more_origins)) {
  std::vector<std::string> names{"127.0.0.1", "localhost", "::1", std::string(host)};
  names.insert(names.end(), more_hosts.begin(), more_hosts.end());
  for (const std::string& name : names) {
    hosts_.push_back(LowerCase(Authority(name, port)));
    // Browsers leave out the port of plain HTTP.
    if (port == 80) hosts_.push_back(hosts_.back().substr(0, hosts_.back().rfind(':')));
  }
  for (const std::string& allowed : hosts_) origins_.push_back("http://" + allowed);
}

base::Status AccessRule::Check(std::string_view host, std::string_view origin) const {
  if (!Contains(hosts_, LowerCase(host))) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "the Host header is " + Quoted(host) + "; open http://" + hosts_.front() +
                          "/ instead, or allow this name when you start the server");
  }
  if (!origin.empty() && !Contains(origins_, LowerCase(origin))) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "a page of " + Quoted(origin) + " may not use this server; open http://" +
                          hosts_.front() + "/ instead, or allow this origin when you start it");
  }
  return {};
}

}  // namespace gsv::gateway
