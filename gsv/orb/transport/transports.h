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

// Call it before each ORB_init(). Without a certificate there are no endpoints for TLS, and calls
// to them fail with a sentence. Fails where the certificate's files cannot be used.
base::Status InstallTransports(const std::optional<CorbaCertificate>& certificate);

// Whether the last call of InstallTransports() gave a certificate.
bool SpeaksTls();

}  // namespace gsv::orb
