// Creates the TLS contexts of servers and clients.
#pragma once

#include <memory>
#include <string>

#include <boost/asio/ssl/context.hpp>

#include "gsv/base/error.h"
#include "gsv/gateway/server/server.h"

namespace gsv::gateway {

// Creates a server context for TLS 1.2 and 1.3. Fails with a sentence if the files are invalid, see
// tls::CheckKeyPair().
base::Result<std::shared_ptr<boost::asio::ssl::context>> MakeTlsContext(const TlsFiles& files);

// Creates a client context that trusts the certificates in the PEM file `authority`; empty: the
// system's authorities.
base::Result<std::shared_ptr<boost::asio::ssl::context>> MakeTlsClientContext(
    const std::string& authority);

}  // namespace gsv::gateway
