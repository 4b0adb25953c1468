// `gsv doctor --security`: lists the open ports of GSV on this machine, and the credentials that
// they require.
//
// Each TCP socket is tested by a connection without credentials, as an unknown client would make.
// The tests change nothing. Unix domain sockets and the UDP sockets of ROS 2 are not tested. The
// environment variables of the process show whether ROS 2 uses keys.
#pragma once

#include <string>

#include "apps/gsv/serving/listeners.h"

namespace gsv::app {

// The protocol of a socket.
enum class Speaks { kHttp, kHttps, kCorba, kCorbaTls, kRos2, kUnknown };

// The result of testing a socket: its protocol, and the credentials that it requires from clients.
struct Exposure {
  Speaks speaks = Speaks::kUnknown;
  bool watching_takes_token = false;  // HTTP and HTTPS: whether watching requires a token
  bool acting_takes_token = false;    // HTTP and HTTPS: whether control requires a token
  bool takes_certificate = false;     // CORBA with TLS: whether clients need a certificate
  bool takes_keys = false;            // ROS 2: whether participants need keys
};

// Tests a socket.
Exposure Probe(const Listener& listener);
// Returns the reason why the exposure should be changed, and the remedy. Returns an empty text if
// no change is needed.
std::string ExposureWarning(const Listener& listener, const Exposure& exposure);

// Prints the sockets of each process; with `json`, one JSON object per process. Returns kOk if there
// is no warning.
int PrintExposure(bool json);

}  // namespace gsv::app
