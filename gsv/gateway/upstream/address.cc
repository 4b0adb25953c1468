#include "gsv/gateway/upstream/address.h"

#include <algorithm>
#include <charconv>

#include "gsv/gateway/server/tls_context.h"

namespace gsv::gateway::upstream {
namespace {

constexpr std::string_view kPlain = "http://", kSecure = "https://";

bool IsPort(std::string_view text) {
  unsigned port = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
  return error == std::errc() && end == text.data() + text.size() && port > 0 && port < 65536;
}

bool IsHost(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char c) {
    return std::isalnum(c) || c == '.' || c == '-' || c == '_' || c == ':';
  });
}

}  // namespace

std::string Address::Authority() const {
  const bool is_ipv6 = host.find(':') != std::string::npos;
  return (is_ipv6 ? "[" + host + "]" : host) + ":" + port;
}

base::Result<Address> ParseAddress(std::string_view url, const std::string& authority_file) {
  const auto refuse = [&] {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "'" + std::string(url.substr(0, 200)) +
                          "' is not the address of a viewer; it looks like http://127.0.0.1:8080/");
  };
  const bool is_secure = url.starts_with(kSecure);
  if (!is_secure && !url.starts_with(kPlain)) return refuse();
  std::string_view authority = url.substr((is_secure ? kSecure : kPlain).size());
  const std::size_t end = authority.find('/');
  if (end != std::string_view::npos) {
    if (end + 1 != authority.size()) return refuse();
    authority = authority.substr(0, end);
  }
  std::string_view host = authority, port = is_secure ? "443" : "80";
  const std::size_t colon = authority.rfind(':');
  const bool is_bracketed = authority.starts_with('[');
  const std::size_t bracket = authority.find(']');
  if (is_bracketed && bracket == std::string_view::npos) return refuse();
  if (colon != std::string_view::npos && (!is_bracketed || colon > bracket)) {
    host = authority.substr(0, colon);
    port = authority.substr(colon + 1);
  }
  if (is_bracketed) {
    if (host.back() != ']') return refuse();
    host = host.substr(1, host.size() - 2);
  } else if (host.find(':') != std::string_view::npos) {
    return refuse();
  }
  if (!IsHost(host) || !IsPort(port)) return refuse();
  Address address{std::string(host), std::string(port)};
  if (!is_secure) return address;
  auto context = MakeTlsClientContext(authority_file);
  if (!context) return base::Fail(context.error());
  address.tls = *std::move(context);
  return address;
}

}  // namespace gsv::gateway::upstream
