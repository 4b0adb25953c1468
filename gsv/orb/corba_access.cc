#include "gsv/orb/corba_access.h"

#include <arpa/inet.h>

#include <cstdlib>
#include <filesystem>

#include "gsv/orb/transport/transports.h"

namespace gsv::orb {
namespace {

namespace fs = std::filesystem;

std::string Variable(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : "";
}

constexpr const char* kAnything = "^* unix,ssl,tcp";
constexpr const char* kPlainOnThisMachine = "^localhost unix,ssl,tcp";
constexpr const char* kTlsElsewhere = "* unix,ssl";

}  // namespace

CorbaAccess AccessFromEnvironment() {
  CorbaAccess access;
  access.is_insecure = Variable("GSV_INSECURE_CORBA") == "1";
  const fs::path certificate = Variable("GSV_CORBA_CERTIFICATE");
  if (certificate.empty()) return access;
  const auto given_or = [](const char* name, const fs::path& beside) {
    const std::string given = Variable(name);
    return given.empty() ? beside : fs::path(given);
  };
  const fs::path folder = certificate.parent_path();
  access.certificate = {
      certificate, given_or("GSV_CORBA_KEY", folder / (certificate.stem().string() + "-key.pem")),
      given_or("GSV_CORBA_AUTHORITY", folder / "ca.pem")};
  return access;
}

base::Status CheckListening(const CorbaAccess& access, const std::string& host) {
  if (IsLoopback(host) || access.certificate || access.is_insecure) return {};
  return base::Fail(base::ErrorCode::kInvalidArgument,
                    "other machines can reach this address and call this program by CORBA: use a "
                    "certificate (`gsv certificates make`; GSV_CORBA_CERTIFICATE), listen on "
                    "127.0.0.1, or allow it with --insecure-corba (GSV_INSECURE_CORBA=1)",
                    host.empty() ? "0.0.0.0" : host);
}

bool IsLoopback(std::string_view host) {
  if (host == "localhost") return true;
  const std::string text(host);
  in_addr v4{};
  in6_addr v6{};
  if (inet_pton(AF_INET, text.c_str(), &v4) == 1) return (ntohl(v4.s_addr) >> 24) == 127;
  return inet_pton(AF_INET6, text.c_str(), &v6) == 1 && IN6_IS_ADDR_LOOPBACK(&v6);
}

base::Result<OrbAccess> PrepareAccess(const std::string& host, int port) {
  const CorbaAccess access = AccessFromEnvironment();
  if (auto allowed = CheckListening(access, host); !allowed) return base::Fail(allowed.error());
  const bool is_ipv6 = host.find(':') != std::string::npos && !host.starts_with('[');
  const std::string address =
      (is_ipv6 ? "[" + host + "]" : host) + ":" + (port > 0 ? std::to_string(port) : std::string());
  if (auto installed = InstallTransports(access.certificate); !installed) {
    return base::Fail(installed.error());
  }
  if (!access.certificate) return OrbAccess{"giop:tcp:" + address, {kAnything, kAnything}};
  if (access.is_insecure) return OrbAccess{"giop:ssl:" + address, {kAnything, kAnything}};
  return OrbAccess{"giop:ssl:" + address, {kPlainOnThisMachine, kTlsElsewhere}};
}

}  // namespace gsv::orb
