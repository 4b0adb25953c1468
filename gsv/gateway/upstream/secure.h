// A connection to another instance, by TLS where its address is an https one.
#pragma once

#include <string>

#include "gsv/gateway/transport/byte_stream.h"
#include "gsv/gateway/upstream/address.h"

namespace gsv::gateway::upstream {

// Once it is connected; then(error_code). The certificate must be good and the address's.
void Secure(transport::ByteStream& stream, const Address& address, transport::Completion then);

// Why there is no connection, and what to do about it.
std::string WhyNotConnected(const boost::system::error_code& error);
inline constexpr char kConnectionHint[] = "is gsv running there, and is the address right?";

}  // namespace gsv::gateway::upstream
