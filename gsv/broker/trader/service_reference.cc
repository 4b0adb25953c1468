#include "gsv/broker/trader/service_reference.h"

#include <optional>

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

// A CDR encapsulation, read from the front. Past the end everything is 0 and ok() is false.
class Encapsulation {
 public:
  explicit Encapsulation(std::string_view bytes) : bytes_(bytes) { little_ = Octet() != 0; }

  bool ok() const { return ok_; }

  std::uint8_t Octet() {
    if (next_ >= bytes_.size()) {
      ok_ = false;
      return 0;
    }
    return static_cast<std::uint8_t>(bytes_[next_++]);
  }

  std::uint32_t Unsigned(std::size_t width) {
    next_ = (next_ + width - 1) / width * width;
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < width; ++i) {
      const std::uint32_t octet = Octet();
      value = little_ ? value | octet << (8 * i) : value << 8 | octet;
    }
    return value;
  }

  std::string_view Octets() {
    const std::uint32_t size = Unsigned(4);
    if (!ok_ || size > bytes_.size() - next_) {
      ok_ = false;
      return {};
    }
    next_ += size;
    return bytes_.substr(next_ - size, size);
  }

  std::string String() {
    std::string_view text = Octets();
    if (!text.empty() && text.back() == '\0') text.remove_suffix(1);
    return std::string(text);
  }

 private:
  std::string_view bytes_;
  std::size_t next_ = 0;
  bool little_ = false;
  bool ok_ = true;
};

// Of a profile, from its object key on; it stays as it is where there is none.
void ReadTlsPort(Encapsulation& profile, ServiceReference& result) {
  profile.Octets();  // the key
  const std::uint32_t components = profile.Unsigned(4);
  for (std::uint32_t i = 0; i < components && profile.ok(); ++i) {
    const std::uint32_t tag = profile.Unsigned(4);
    Encapsulation component(profile.Octets());
    if (tag != kSslComponent) continue;
    component.Unsigned(2);  // what the target supports and
    component.Unsigned(2);  // what it requires
    const std::uint32_t port = component.Unsigned(2);
    if (!component.ok() || port == 0) return;
    result.port = static_cast<std::uint16_t>(port);
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
  Encapsulation reference(*bytes);
  ServiceReference result;
  result.type_id = reference.String();
  const std::uint32_t profiles = reference.Unsigned(4);
  for (std::uint32_t i = 0; i < profiles && reference.ok() && result.host.empty(); ++i) {
    const std::uint32_t tag = reference.Unsigned(4);
    Encapsulation profile(reference.Octets());
    if (tag != kIiopProfile) continue;
    profile.Octet();                             // the major and
    const std::uint8_t minor = profile.Octet();  // the minor version of IIOP
    result.host = profile.String();
    result.port = static_cast<std::uint16_t>(profile.Unsigned(2));
    if (!profile.ok()) return corrupt();
    if (result.port == 0 && minor > 0) ReadTlsPort(profile, result);
  }
  if (!reference.ok()) return corrupt();
  return result;
}
}  // namespace gsv::broker
