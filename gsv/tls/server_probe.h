// TLS as somebody speaks it who trusts nobody and shows nothing: to find out what a server tells to
// strangers.
#pragma once

#include <string>

namespace gsv::tls {

struct ProbeResult {
  bool asks_for_certificate = false;  // of who connects
  std::string answer;                 // its beginning; empty: there is none
};

// Begins TLS on a connected socket, whoever answers, and sends `request`. The socket's own time
// limits hold.
ProbeResult ProbeServer(int descriptor, const std::string& request);

}  // namespace gsv::tls
