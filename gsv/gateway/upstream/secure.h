// Sets up TLS for connections to another instance with https.
#pragma once

#include <string>

#include "gsv/gateway/transport/byte_stream.h"
#include "gsv/gateway/upstream/address.h"

namespace gsv::gateway::upstream {

// Call it after connecting; it calls then(error_code). The certificate must be valid for the
// address.
void Secure(transport::ByteStream& stream, const Address& address, transport::Completion then);

// Returns the reason for a failed connection, with advice.
std::string WhyNotConnected(const boost::system::error_code& error);
inline constexpr char kConnectionHint[] = "check that gsv runs there and that the address is right";

}  // namespace gsv::gateway::upstream
