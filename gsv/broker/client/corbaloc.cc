#include "gsv/broker/client/corbaloc.h"

#include "gsv/broker/trader/service_reference.h"

namespace gsv::broker {
namespace {

constexpr std::string_view kScheme = "corbaloc:";
constexpr std::string_view kProtocol = "iiop:";
constexpr std::string_view kTlsProtocol = "ssliop:";

base::Error Misspelt(std::string_view reference) {
  return {base::ErrorCode::kInvalidArgument,
          "the address of a broker has the form corbaloc::1.2@HOST:PORT/TradingService",
          std::string(reference)};
}

}  // namespace

base::Result<std::string> NormaliseReference(std::string_view reference) {
  if (reference.starts_with("IOR:")) {
    if (!ReadReference(reference)) return base::Fail(Misspelt(reference));
    return std::string(reference);
  }
  if (!reference.starts_with(kScheme)) return base::Fail(Misspelt(reference));
  std::string_view address = reference.substr(kScheme.size());
  const bool takes_tls = address.starts_with(kTlsProtocol);
  if (takes_tls) {
    address.remove_prefix(kTlsProtocol.size());
  } else if (address.starts_with(kProtocol)) {
    address.remove_prefix(kProtocol.size());
  } else if (address.starts_with(":")) {
    address.remove_prefix(1);
  } else {
    return std::string(reference);  // the only other protocol is rir, which needs no version
  }
  const std::size_t slash = address.find('/');
  if (slash == 0 || slash == std::string_view::npos || slash + 1 == address.size()) {
    return base::Fail(Misspelt(reference));
  }
  const bool has_version = address.substr(0, slash).find('@') != std::string_view::npos;
  return std::string(kScheme) + (takes_tls ? std::string(kTlsProtocol) : ":") +
         (has_version ? "" : "1.2@") + std::string(address);
}

bool TakesTls(std::string_view reference) {
  if (const auto ior = ReadReference(reference)) return ior->takes_tls;
  return reference.starts_with(std::string(kScheme) + std::string(kTlsProtocol));
}

std::string HostOf(std::string_view reference) {
  if (const auto ior = ReadReference(reference)) return ior->host;
  const std::size_t at = reference.find('@');
  if (at == std::string_view::npos) return {};
  std::string_view address = reference.substr(at + 1);
  address = address.substr(0, address.find('/'));
  if (address.starts_with("[")) return std::string(address.substr(1, address.find(']') - 1));
  return std::string(address.substr(0, address.find(':')));
}

}  // namespace gsv::broker
