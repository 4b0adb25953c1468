// `gsv doctor --security`: what of GSV can be reached on this machine, by whom, and what it takes.
//
// Each listening socket is asked, as a stranger would ask it: nothing is believed that an option
// said. Nothing is changed by asking.
#pragma once

#include <string>

#include "apps/gsv/serving/listeners.h"

namespace gsv::app {

enum class Speaks { kHttp, kHttps, kCorba, kCorbaTls, kRos2, kUnknown };

struct Exposure {
  Speaks speaks = Speaks::kUnknown;
  bool watching_takes_token = false;  // of HTTP and HTTPS
  bool acting_takes_token = false;
  bool takes_certificate = false;  // of CORBA by TLS
};

Exposure Probe(const Listener& listener);
// Why this should not stay as it is, and what to do; empty: it may.
std::string Complaint(const Listener& listener, const Exposure& exposure);

// Prints a line for each socket. kOk when nothing is complained of.
int TellExposure(bool json);

}  // namespace gsv::app
