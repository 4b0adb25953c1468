// The transports of this process's ORB, in the place of omniORB's own: TCP, sockets in the file
// system, and TLS. On the wire and in references they are the same; "giop:ssl" is what other ORBs
// call SSLIOP. ADR 021, 023 and 029 give the reasons.
//
// Threads  any.
#pragma once

#include <optional>

#include "gsv/base/error.h"
#include "gsv/orb/transport/tls_context.h"

namespace gsv::orb {

// Call it before each ORB_init(). If there is no certificate, there are no endpoints for TLS, and
// calls to such endpoints fail with a sentence. Fails if the files of the certificate are invalid.
base::Status InstallTransports(const std::optional<CorbaCertificate>& certificate);

// Whether the last call of InstallTransports() had a certificate.
bool SpeaksTls();

}  // namespace gsv::orb
