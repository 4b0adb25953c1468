// Sets up TLS for connections to another instance with https.
#pragma once

#include <string>

#include "gsv/gateway/transport/byte_stream.h"
#include "gsv/gateway/upstream/address.h"

namespace gsv::gateway::upstream {

// Begins TLS on a connected stream if `address` requires TLS, then calls then(error_code). Fails if
// the certificate is not valid for the address.
void StartTls(transport::ByteStream& stream, const Address& address, transport::Completion then);

// Returns the reason for a failed connection, with advice.
std::string WhyNotConnected(const boost::system::error_code& error);
// Advice for the user if no connection can be made.
inline constexpr char kConnectionHint[] = "check that gsv runs there and that the address is right";

}  // namespace gsv::gateway::upstream
