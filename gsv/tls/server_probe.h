// Probes a TLS server without a client certificate and without verifying the server: which data
// does it send to an unauthenticated client?
#pragma once

#include <string>

namespace gsv::tls {

struct ProbeResult {
  bool asks_for_certificate = false;  // requests a client certificate
  std::string answer;                 // the start of the response; empty: none
};

// Performs a TLS handshake on a connected socket with any peer and sends `request`. The time limits
// of the socket apply.
ProbeResult ProbeServer(int descriptor, const std::string& request);

}  // namespace gsv::tls
