// Access control of CORBA. Without a certificate, only programs on this machine may call this
// process. With a certificate, a program on any host may call this process by TLS if both have
// certificates of the same authority. The process then accepts no calls by plain TCP, and makes
// plain TCP calls only to services on this machine.
// GSV_CORBA_CERTIFICATE  a PEM file, such as `gsv certificates make` writes
// GSV_CORBA_KEY          its key (default: NAME-key.pem beside NAME.pem)
// GSV_CORBA_AUTHORITY    the trusted authority (default: ca.pem beside NAME.pem)
// GSV_INSECURE_CORBA     1: no access control for incoming and outgoing calls
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "gsv/base/error.h"
#include "gsv/orb/transport/tls_context.h"

namespace gsv::orb {

struct CorbaAccess {
  // Certificate of this process; nullopt: no TLS, only calls on this machine.
  std::optional<CorbaCertificate> certificate;
  bool is_insecure = false;  // whether GSV_INSECURE_CORBA turns access control off
};

// Reads the environment variables above.
CorbaAccess AccessFromEnvironment();

// Checks whether a server may listen on `host`. If not, returns kInvalidArgument with a sentence
// about what is required.
base::Status CheckListening(const CorbaAccess& access, const std::string& host);

// Whether the host is in 127.0.0.0/8, ::1 or "localhost".
bool IsLoopback(std::string_view host);

// Settings for CORBA::ORB_init() that apply the environment's variables.
struct OrbAccess {
  std::string endpoint;                     // for example "giop:ssl:127.0.0.1:"
  std::array<const char*, 2> client_rules;  // clientTransportRule, each
};

// Call this before each CORBA::ORB_init() of a process that listens on `host`. Port 0 lets the
// system choose the port. Installs the transports. Fails with a sentence that names the file or the
// missing setting.
base::Result<OrbAccess> PrepareAccess(const std::string& host, int port);

}  // namespace gsv::orb
