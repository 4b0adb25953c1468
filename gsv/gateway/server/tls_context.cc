#include "gsv/gateway/server/tls_context.h"

#include <openssl/ssl.h>

#include "gsv/tls/certificates.h"

namespace gsv::gateway {

namespace ssl = boost::asio::ssl;

base::Result<std::shared_ptr<ssl::context>> MakeTlsContext(const TlsFiles& files) {
  if (files.certificate.empty() || files.key.empty()) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "TLS needs a certificate and its key; `gsv certificates make` makes them");
  }
  if (auto good = tls::CheckKeyPair(files.certificate, files.key); !good) {
    return base::Fail(good.error());
  }
  auto context = std::make_shared<ssl::context>(ssl::context::tls_server);
  boost::system::error_code error;
  context->use_certificate_chain_file(files.certificate, error);
  if (!error) context->use_private_key_file(files.key, ssl::context::pem, error);
  if (error) {
    return base::Fail(base::ErrorCode::kInvalidArgument, "OpenSSL refuses it: " + error.message(),
                      files.certificate);
  }
  SSL_CTX_set_min_proto_version(context->native_handle(), TLS1_2_VERSION);
  return context;
}

base::Result<std::shared_ptr<ssl::context>> MakeTlsClientContext(const std::string& authority) {
  auto context = std::make_shared<ssl::context>(ssl::context::tls_client);
  boost::system::error_code error;
  if (authority.empty()) {
    context->set_default_verify_paths(error);
  } else {
    if (auto good = tls::CheckAuthority(authority); !good) return base::Fail(good.error());
    context->load_verify_file(authority, error);
  }
  if (error) {
    return base::Fail(base::ErrorCode::kInvalidArgument, "OpenSSL refuses it: " + error.message(),
                      authority);
  }
  SSL_CTX_set_min_proto_version(context->native_handle(), TLS1_2_VERSION);
  return context;
}

}  // namespace gsv::gateway
