// Who may call this process by CORBA, and whom it calls. Without a certificate: programs of this
// machine. With one: every program that shows one of the same authority, from anywhere, by TLS.
// Then the process takes no calls by TCP without TLS, and calls only this machine's services that
// way.
//
// GSV_CORBA_CERTIFICATE  a PEM file, as `gsv certificates make` makes it
// GSV_CORBA_KEY          its key; without it NAME-key.pem beside NAME.pem
// GSV_CORBA_AUTHORITY    whose certificates are taken; without it ca.pem beside NAME.pem
// GSV_INSECURE_CORBA     1: anybody who reaches this process may call it, and be called
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "gsv/base/error.h"
#include "gsv/orb/transport/tls_context.h"

namespace gsv::orb {

struct CorbaAccess {
  std::optional<CorbaCertificate> certificate;
  bool is_insecure = false;
};

CorbaAccess AccessFromEnvironment();

// Whether a server may listen there. kInvalidArgument: what it takes.
base::Status CheckListening(const CorbaAccess& access, const std::string& host);

// True for 127.0.0.0/8, ::1 and "localhost".
bool IsLoopback(std::string_view host);

// Settings for CORBA::ORB_init() that apply the environment's variables.
struct OrbAccess {
  std::string endpoint;                     // "giop:ssl:127.0.0.1:"
  std::array<const char*, 2> client_rules;  // clientTransportRule, each
};

// Before each CORBA::ORB_init() of a process that listens on `host`; port 0: any. Installs the
// transports. Fails with a sentence that names the file or says what is missing.
base::Result<OrbAccess> PrepareAccess(const std::string& host, int port);

}  // namespace gsv::orb
