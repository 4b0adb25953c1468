#include "gsv/broker/trader/service_reference.h"

#include <optional>

#include "gsv/base/cdr_reader.h"

namespace gsv::broker {
namespace {

constexpr std::uint32_t kIiopProfile = 0;
constexpr std::uint32_t kSslComponent = 20;

std::optional<std::string> FromHex(std::string_view digits) {
  const auto nibble = [](char c) -> int {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
  };
  if (digits.size() % 2 != 0) return std::nullopt;
  std::string bytes;
  for (std::size_t i = 0; i < digits.size(); i += 2) {
    const int high = nibble(digits[i]);
    const int low = nibble(digits[i + 1]);
    if (high < 0 || low < 0) return std::nullopt;
    bytes.push_back(static_cast<char>(high << 4 | low));
  }
  return bytes;
}

// Reads a string that may lack its terminating null.
std::string ReadText(base::CdrReader& in) {
  std::string_view text = in.Octets();
  if (!text.empty() && text.back() == '\0') text.remove_suffix(1);
  return std::string(text);
}

// Reads the port for TLS from `profile`. The next value of `profile` must be its object key. Leaves
// `result` unchanged if the profile has no port for TLS.
void ReadTlsPort(base::CdrReader& profile, ServiceReference& result) {
  profile.Octets();  // skips the object key
  const std::uint32_t components = profile.ULong();
  for (std::uint32_t i = 0; i < components && profile.ok(); ++i) {
    const std::uint32_t tag = profile.ULong();
    base::CdrReader component = base::CdrReader::OfEncapsulation(profile.Octets());
    if (tag != kSslComponent) continue;
    component.UShort();  // skips the supported options of the target
    component.UShort();  // skips the required options
    const std::uint16_t port = component.UShort();
    if (!component.ok() || port == 0) return;
    result.port = port;
    result.takes_tls = true;
    return;
  }
}

}  // namespace

std::string ServiceReference::Address() const {
  if (host.empty()) return {};
  const std::string port_text = ":" + std::to_string(port);
  return host.find(':') == std::string::npos ? host + port_text : "[" + host + "]" + port_text;
}

base::Result<ServiceReference> ReadReference(std::string_view ior) {
  const auto corrupt = [] {
    return base::Fail(base::ErrorCode::kCorrupt, "this is not an object reference (\"IOR:…\")");
  };
  if (!ior.starts_with("IOR:")) return corrupt();
  const auto bytes = FromHex(ior.substr(4));
  if (!bytes) return corrupt();
  base::CdrReader reference = base::CdrReader::OfEncapsulation(*bytes);
  ServiceReference result;
  result.type_id = ReadText(reference);
  const std::uint32_t profiles = reference.ULong();
  for (std::uint32_t i = 0; i < profiles && reference.ok() && result.host.empty(); ++i) {
    const std::uint32_t tag = reference.ULong();
    base::CdrReader profile = base::CdrReader::OfEncapsulation(reference.Octets());
    if (tag != kIiopProfile) continue;
    profile.Octet();                             // skips the major version of IIOP
    const std::uint8_t minor = profile.Octet();  // the minor version of IIOP
    result.host = ReadText(profile);
    result.port = profile.UShort();
    if (!profile.ok()) return corrupt();
    if (result.port == 0 && minor > 0) ReadTlsPort(profile, result);
  }
  if (!reference.ok()) return corrupt();
  return result;
}

}  // namespace gsv::broker
