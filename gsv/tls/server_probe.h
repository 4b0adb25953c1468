// Probes which data a TLS server sends to a client without a certificate. The server's certificate
// is not verified.
#pragma once

#include <string>

namespace gsv::tls {

struct ProbeResult {
  bool asks_for_certificate = false;  // whether the server requests a client certificate
  std::string answer;                 // the start of the response; empty if there is none
};

// Performs a TLS handshake on a connected socket and sends `request`. Accepts any certificate of
// the server. The time limits of the socket apply.
ProbeResult ProbeServer(int descriptor, const std::string& request);

}  // namespace gsv::tls
