#include "gsv/tls/stranger.h"

#include <memory>

#include <openssl/ssl.h>

namespace gsv::tls {

std::string ExchangeAsStranger(int descriptor, const std::string& request) {
  const std::unique_ptr<SSL_CTX, decltype(&SSL_CTX_free)> context(SSL_CTX_new(TLS_client_method()),
                                                                  &SSL_CTX_free);
  if (!context) return {};
  SSL_CTX_set_verify(context.get(), SSL_VERIFY_NONE, nullptr);
  const std::unique_ptr<SSL, decltype(&SSL_free)> connection(SSL_new(context.get()), &SSL_free);
  if (!connection || SSL_set_fd(connection.get(), descriptor) != 1) return {};
  if (SSL_connect(connection.get()) != 1) return {};
  if (SSL_write(connection.get(), request.data(), static_cast<int>(request.size())) <= 0) return {};
  std::string answer(4096, '\0');
  const int length = SSL_read(connection.get(), answer.data(), static_cast<int>(answer.size()));
  answer.resize(length > 0 ? static_cast<std::size_t>(length) : 0);
  return answer;
}

}  // namespace gsv::tls
