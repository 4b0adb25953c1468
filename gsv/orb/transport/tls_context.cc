#include "gsv/orb/transport/tls_context.h"

#include <string>

#include <openssl/err.h>
#include <openssl/ssl.h>

#include "gsv/tls/certificates.h"

namespace gsv::orb {

base::Result<std::shared_ptr<const TlsContext>> TlsContext::Read(const CorbaCertificate& files) {
  // The certificate is checked first: if its name is wrong, the default names of the other files
  // are wrong, too (see corba_access.h).
  if (auto good = tls::CheckKeyPair(files.certificate, files.key); !good) {
    return base::Fail(good.error());
  }
  if (auto good = tls::CheckAuthority(files.authority); !good) return base::Fail(good.error());
  const auto no_password = [](char*, int, int, void*) { return -1; };
  const std::shared_ptr<TlsContext> made(new TlsContext(SSL_CTX_new(TLS_method())));
  SSL_CTX* const context = made->get();
  if (context == nullptr)
    return base::Fail(base::ErrorCode::kUnavailable, "OpenSSL cannot be initialised");
  SSL_CTX_set_min_proto_version(context, TLS1_2_VERSION);
  SSL_CTX_set_options(context, SSL_OP_NO_RENEGOTIATION | SSL_OP_NO_TICKET);
  SSL_CTX_set_num_tickets(context, 0);
  SSL_CTX_set_session_cache_mode(context, SSL_SESS_CACHE_OFF);
  SSL_CTX_set_mode(context, SSL_MODE_ENABLE_PARTIAL_WRITE | SSL_MODE_ACCEPT_MOVING_WRITE_BUFFER);
  SSL_CTX_set_default_passwd_cb(context, no_password);
  SSL_CTX_set_verify(context, SSL_VERIFY_PEER | SSL_VERIFY_FAIL_IF_NO_PEER_CERT, nullptr);
  ERR_clear_error();
  if (SSL_CTX_use_certificate_chain_file(context, files.certificate.c_str()) != 1 ||
      SSL_CTX_use_PrivateKey_file(context, files.key.c_str(), SSL_FILETYPE_PEM) != 1 ||
      SSL_CTX_load_verify_locations(context, files.authority.c_str(), nullptr) != 1) {
    const char* const why = ERR_reason_error_string(ERR_get_error());
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      std::string("OpenSSL rejects it: ") + (why != nullptr ? why : "?"),
                      files.certificate);
  }
  SSL_CTX_set_client_CA_list(context, SSL_load_client_CA_file(files.authority.c_str()));
  return made;
}

TlsContext::~TlsContext() { SSL_CTX_free(context_); }

}  // namespace gsv::orb
