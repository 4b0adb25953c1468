// Addresses of brokers: "corbaloc::HOST:PORT/TradingService" for TCP, and
// "corbaloc:ssliop:HOST:PORT/TradingService" for TLS.
#pragma once

#include <string>
#include <string_view>

#include "gsv/base/error.h"

namespace gsv::broker {

// Adds GIOP version 1.2 to a "corbaloc:" without a version, for which an ORB would use 1.0. Returns
// an "IOR:" unchanged.
// Errors  kInvalidArgument, with the forms that a reference may have.
base::Result<std::string> NormaliseReference(std::string_view reference);

// Whether the address is of a broker that accepts only TLS.
bool TakesTls(std::string_view reference);

// The host in a normalised reference; empty when it names none.
std::string HostOf(std::string_view reference);

}  // namespace gsv::broker
