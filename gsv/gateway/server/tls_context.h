// What a server shows to those who connect by TLS, and whom those trust who connect to one.
#pragma once

#include <memory>
#include <string>

#include <boost/asio/ssl/context.hpp>

#include "gsv/base/error.h"
#include "gsv/gateway/server/server.h"

namespace gsv::gateway {

// TLS 1.2 and 1.3. Fails with a sentence when the files cannot be used: see tls::CheckKeyPair().
base::Result<std::shared_ptr<boost::asio::ssl::context>> MakeTlsContext(const TlsFiles& files);

// To call servers whose certificate `authority` signed, a PEM file; empty: whom the system trusts.
base::Result<std::shared_ptr<boost::asio::ssl::context>> MakeTlsClientContext(
    const std::string& authority);

}  // namespace gsv::gateway
