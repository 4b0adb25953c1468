// Addresses of brokers: "corbaloc::HOST:PORT/TradingService" for TCP, and
// "corbaloc:ssliop:HOST:PORT/TradingService" for TLS.
#pragma once

#include <string>
#include <string_view>

#include "gsv/base/error.h"

namespace gsv::broker {

// Adds GIOP version 1.2 to a "corbaloc:" without a version, because an ORB would use 1.0 for it.
// Returns an "IOR:" unchanged.
// Errors  kInvalidArgument, with the form of a reference.
base::Result<std::string> NormaliseReference(std::string_view reference);

// Whether the address belongs to a broker that accepts only TLS.
bool TakesTls(std::string_view reference);

// Returns the host in a normalised reference, or an empty text if the reference contains no host.
std::string HostOf(std::string_view reference);

}  // namespace gsv::broker
