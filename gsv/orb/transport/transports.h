// Replaces omniORB's transports (TCP, Unix domain sockets and TLS) in this process. The protocols
// and references are unchanged: other ORBs use the name SSLIOP for the TLS transport "giop:ssl".
// ADR 021, 023 and 029 give the reasons.
//
// Threads  any.
#pragma once

#include <optional>

#include "gsv/base/error.h"
#include "gsv/orb/transport/tls_context.h"

namespace gsv::orb {

// Call this before each ORB_init(). Without a certificate, TLS has no endpoints, and calls to TLS
// endpoints fail with a sentence. Fails if the files of the certificate are invalid.
base::Status InstallTransports(const std::optional<CorbaCertificate>& certificate);

// Whether the last call of InstallTransports() had a certificate.
bool SpeaksTls();

}  // namespace gsv::orb
