// The certificate of this process for TLS, and the authority whose certificates it accepts.
#pragma once

#include <filesystem>
#include <memory>

#include "gsv/base/error.h"

struct ssl_ctx_st;

namespace gsv::orb {

// The PEM files of a certificate, of its private key, and of the authority that is trusted.
struct CorbaCertificate {
  std::filesystem::path certificate, key, authority;

  bool operator==(const CorbaCertificate&) const = default;
};

// An OpenSSL context that was made from a CorbaCertificate.
class TlsContext {
 public:
  // Reads the files. Fails with a sentence that names the invalid file.
  static base::Result<std::shared_ptr<const TlsContext>> Read(const CorbaCertificate& files);
  ~TlsContext();
  TlsContext(const TlsContext&) = delete;
  TlsContext& operator=(const TlsContext&) = delete;

  ssl_ctx_st* get() const { return context_; }

 private:
  explicit TlsContext(ssl_ctx_st* context) : context_(context) {}
  ssl_ctx_st* context_;
};

}  // namespace gsv::orb
