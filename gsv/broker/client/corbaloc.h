// Addresses of brokers, as people write them: "corbaloc::HOST:PORT/TradingService", and with
// "ssliop" between the colons that of one which takes TLS.
#pragma once

#include <string>
#include <string_view>

#include "gsv/base/error.h"

namespace gsv::broker {

// A "corbaloc:" with the GIOP version 1.2 put in where none is given (without one an ORB speaks
// 1.0), or an "IOR:" as it is.
// Errors  kInvalidArgument, saying what a reference looks like.
base::Result<std::string> NormaliseReference(std::string_view reference);

// Whether it names one that takes TLS, and nothing else.
bool TakesTls(std::string_view reference);

// The host in a normalised reference; empty when it names none.
std::string HostOf(std::string_view reference);

}  // namespace gsv::broker
