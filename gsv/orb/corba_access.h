// Who may call this process by CORBA, and whom it calls. Without a certificate: programs of this
// machine. With one: whoever shows one that the same authority has signed, from anywhere, by TLS;
// by TCP without TLS nothing is taken then, and only this machine's services are called so.
//
// GSV_CORBA_CERTIFICATE  a PEM file, as `gsv certificates make` makes it
// GSV_CORBA_KEY          its key; without it NAME-key.pem beside NAME.pem
// GSV_CORBA_AUTHORITY    whose certificates are taken; without it ca.pem beside NAME.pem
// GSV_INSECURE_CORBA     1: anybody who reaches this process may call it, and be called
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "gsv/base/error.h"

namespace omni {
class giopTransportImpl;
}

namespace gsv::orb {

class TlsContext;

struct CorbaCertificate {
  std::filesystem::path certificate, key, authority;

  bool operator==(const CorbaCertificate&) const = default;
};

struct CorbaAccess {
  std::optional<CorbaCertificate> certificate;
  bool is_insecure = false;
};

CorbaAccess AccessOfEnvironment();

// Whether a server may listen there. kInvalidArgument: what it takes.
base::Status CheckListening(const CorbaAccess& access, const std::string& host);

// True for 127.0.0.0/8, ::1 and "localhost".
bool IsLoopback(std::string_view host);

// Whether this process's ORB speaks TLS.
bool SpeaksTls();

// What CORBA::ORB_init() takes so that the environment's wishes hold.
struct OrbAccess {
  std::string endpoint;                     // "giop:ssl:127.0.0.1:"
  std::array<const char*, 2> client_rules;  // clientTransportRule, each
};

// Makes omniORB's transport for TLS. It must live as long as ORBs do.
using MakeTransport =
    std::function<std::unique_ptr<omni::giopTransportImpl>(std::shared_ptr<const TlsContext>)>;

// Before each CORBA::ORB_init() of a process that listens on `host`; port 0: any. Fails with a
// sentence that names the file or says what lacks.
base::Result<OrbAccess> PrepareAccess(const std::string& host, int port,
                                      const MakeTransport& make_transport);
base::Result<OrbAccess> PrepareAccess(const std::string& host, int port);

}  // namespace gsv::orb
