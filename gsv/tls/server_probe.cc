#include "gsv/tls/server_probe.h"

#include <memory>
#include <utility>

#include <openssl/ssl.h>

namespace gsv::tls {

ProbeResult ProbeServer(int descriptor, const std::string& request) {
  ProbeResult reception;
  const std::unique_ptr<SSL_CTX, decltype(&SSL_CTX_free)> context(SSL_CTX_new(TLS_client_method()),
                                                                  &SSL_CTX_free);
  if (!context) return reception;
  SSL_CTX_set_verify(context.get(), SSL_VERIFY_NONE, nullptr);
  // OpenSSL calls this function when the server requests a client certificate. The function stores
  // this fact, and returns 0 because the probe has no certificate.
  SSL_CTX_set_app_data(context.get(), &reception);
  SSL_CTX_set_client_cert_cb(context.get(), [](SSL* connection, X509**, EVP_PKEY**) {
    static_cast<ProbeResult*>(SSL_CTX_get_app_data(SSL_get_SSL_CTX(connection)))
        ->asks_for_certificate = true;
    return 0;
  });
  const std::unique_ptr<SSL, decltype(&SSL_free)> connection(SSL_new(context.get()), &SSL_free);
  if (!connection || SSL_set_fd(connection.get(), descriptor) != 1) return reception;
  if (SSL_connect(connection.get()) != 1) return reception;
  if (SSL_write(connection.get(), request.data(), static_cast<int>(request.size())) <= 0) {
    return reception;
  }
  std::string answer(4096, '\0');
  const int length = SSL_read(connection.get(), answer.data(), static_cast<int>(answer.size()));
  answer.resize(length > 0 ? static_cast<std::size_t>(length) : 0);
  reception.answer = std::move(answer);
  return reception;
}

}  // namespace gsv::tls
