#include "gsv/tls/certificates.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include <openssl/bio.h>
#include <openssl/bn.h>
#include <openssl/ec.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/rand.h>
#include <openssl/x509.h>
#include <openssl/x509v3.h>

namespace gsv::tls {
namespace {

namespace fs = std::filesystem;
using base::ErrorCode;

template <auto Free>
struct Freed {
  template <typename T>
  void operator()(T* object) const {
    Free(object);
  }
};
using Key = std::unique_ptr<EVP_PKEY, Freed<&EVP_PKEY_free>>;
using Certificate = std::unique_ptr<X509, Freed<&X509_free>>;
using File = std::unique_ptr<std::FILE, Freed<&std::fclose>>;

base::Status CannotWrite(const fs::path& file) {
  const std::string why = errno == EEXIST
                              ? "it already exists; remove it first, or choose another folder"
                              : std::string("cannot write: ") + std::strerror(errno);
  return base::Fail(ErrorCode::kUnavailable, why, file);
}

base::Error CannotRead(const fs::path& file, const char* what) {
  return {ErrorCode::kUnavailable,
          std::string("cannot read ") + what + " here, in PEM format" +
              (errno != 0 ? std::string(": ") + std::strerror(errno) : std::string()),
          file};
}

// Returns the error for an internal failure of OpenSSL, such as no memory or no entropy.
base::Status Failed() {
  return base::Fail(ErrorCode::kUnavailable, "OpenSSL cannot be initialised");
}

File CreateFile(const fs::path& path, mode_t mode) {
  const int descriptor = open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
  return File(descriptor < 0 ? nullptr : fdopen(descriptor, "w"));
}

File OpenFile(const fs::path& path) {
  errno = 0;
  return File(std::fopen(path.c_str(), "re"));
}

base::Result<Certificate> ReadCertificate(const fs::path& path) {
  const File file = OpenFile(path);
  Certificate read(file ? PEM_read_X509(file.get(), nullptr, nullptr, nullptr) : nullptr);
  if (!read) return base::Fail(CannotRead(path, "a certificate"));
  return read;
}

base::Result<Key> ReadKey(const fs::path& path) {
  const File file = OpenFile(path);
  // A key with a password needs a user who enters the password. This callback makes reading such a
  // key fail.
  const auto no_password = [](char*, int, int, void*) { return -1; };
  Key read(file ? PEM_read_PrivateKey(file.get(), nullptr, no_password, nullptr) : nullptr);
  if (!read) return base::Fail(CannotRead(path, "a key without a password"));
  return read;
}

// "DNS:lab-7,IP:10.0.0.7"
std::string AlternativeNames(const std::vector<std::string>& hosts) {
  std::string names;
  for (const std::string& host : hosts) {
    std::array<unsigned char, 16> address{};
    const bool is_address = inet_pton(AF_INET, host.c_str(), address.data()) == 1 ||
                            inet_pton(AF_INET6, host.c_str(), address.data()) == 1;
    names += (names.empty() ? "" : ",") + std::string(is_address ? "IP:" : "DNS:") + host;
  }
  return names;
}

bool Extend(X509* certificate, X509* issuer, int extension, const std::string& value) {
  X509V3_CTX context{};
  X509V3_set_ctx(&context, issuer, certificate, nullptr, nullptr, 0);
  X509_EXTENSION* const made = X509V3_EXT_conf_nid(nullptr, &context, extension, value.c_str());
  const bool is_added = made != nullptr && X509_add_ext(certificate, made, -1) == 1;
  X509_EXTENSION_free(made);
  return is_added;
}

// Sets a random serial number of 127 bits, so that the serial numbers of an authority are unique
// (RFC 5280, 4.1.2.2).
bool SetSerial(X509* certificate) {
  std::array<unsigned char, 16> bytes{};
  if (RAND_bytes(bytes.data(), bytes.size()) != 1) return false;
  bytes[0] = static_cast<unsigned char>((bytes[0] & 0x7F) | 0x40);
  BIGNUM* const number = BN_bin2bn(bytes.data(), bytes.size(), nullptr);
  const bool is_set = BN_to_ASN1_INTEGER(number, X509_get_serialNumber(certificate)) != nullptr;
  BN_free(number);
  return is_set;
}

// Begins a certificate without issuer and signature.
Certificate Begin(EVP_PKEY* key, const std::string& name, const Validity& validity) {
  Certificate made(X509_new());
  X509_NAME* const subject = X509_get_subject_name(made.get());
  const auto* const text = reinterpret_cast<const unsigned char*>(name.c_str());
  const bool is_good =
      X509_set_version(made.get(), X509_VERSION_3) == 1 && SetSerial(made.get()) &&
      X509_gmtime_adj(X509_getm_notBefore(made.get()), validity.begins.count()) != nullptr &&
      X509_gmtime_adj(X509_getm_notAfter(made.get()), validity.ends.count()) != nullptr &&
      X509_set_pubkey(made.get(), key) == 1 &&
      X509_NAME_add_entry_by_txt(subject, "CN", MBSTRING_UTF8, text, -1, -1, 0) == 1;
  return is_good ? std::move(made) : nullptr;
}

base::Status Write(const fs::path& folder, const std::string& name, X509* certificate,
                   EVP_PKEY* key) {
  const fs::path key_path = folder / (name + "-key.pem"), path = folder / (name + ".pem");
  const File key_file = CreateFile(key_path, 0600);
  if (!key_file) return CannotWrite(key_path);
  const File file = CreateFile(path, 0644);
  if (!file) {
    std::error_code ignored;
    fs::remove(key_path, ignored);
    errno = EEXIST;
    return CannotWrite(path);
  }
  if (PEM_write_PrivateKey(key_file.get(), key, nullptr, nullptr, 0, nullptr, nullptr) != 1 ||
      PEM_write_X509(file.get(), certificate) != 1 || std::fflush(key_file.get()) != 0 ||
      std::fflush(file.get()) != 0) {
    return CannotWrite(path);
  }
  return {};
}

bool IsName(const std::string& name) {
  return !name.empty() && name.size() <= 64 && name[0] != '.' && name != "ca" &&
         std::all_of(name.begin(), name.end(), [](unsigned char c) {
           return std::isalnum(c) != 0 || c == '-' || c == '.' || c == '_';
         });
}

bool IsHost(const std::string& host) {
  return !host.empty() && host.size() <= 253 &&
         std::all_of(host.begin(), host.end(), [](unsigned char c) {
           return std::isalnum(c) != 0 || c == '-' || c == '.' || c == ':';
         });
}

base::Status CheckRequest(const CertificateRequest& request) {
  if (!IsName(request.name)) {
    return base::Fail(ErrorCode::kInvalidArgument,
                      "a certificate's name has 1 to 64 letters, digits and characters of -._, "
                      "does not begin with a dot, and is not \"ca\"",
                      request.name);
  }
  for (const std::string& host : request.hosts) {
    if (!IsHost(host)) {
      return base::Fail(ErrorCode::kInvalidArgument, "this is not a host name or an address", host);
    }
  }
  return {};
}

}  // namespace

base::Status MakeAuthority(const fs::path& folder, const Validity& validity) {
  std::error_code error;
  if (!fs::exists(folder, error)) {
    fs::create_directories(folder, error);
    if (!error) fs::permissions(folder, fs::perms::owner_all, error);
    if (error) return base::Fail(ErrorCode::kUnavailable, error.message(), folder);
  }
  const Key key(EVP_EC_gen("P-256"));
  const Certificate made = key ? Begin(key.get(), "gsv authority", validity) : nullptr;
  if (!made) return Failed();
  X509_set_issuer_name(made.get(), X509_get_subject_name(made.get()));
  // The authority may sign certificates of servers and clients, but no further authorities.
  if (!Extend(made.get(), made.get(), NID_basic_constraints, "critical,CA:TRUE,pathlen:0") ||
      !Extend(made.get(), made.get(), NID_key_usage, "critical,keyCertSign,cRLSign") ||
      !Extend(made.get(), made.get(), NID_subject_key_identifier, "hash") ||
      X509_sign(made.get(), key.get(), EVP_sha256()) == 0) {
    return Failed();
  }
  return Write(folder, "ca", made.get(), key.get());
}

bool HasAuthority(const fs::path& folder) {
  std::error_code ignored;
  return fs::exists(folder / "ca.pem", ignored) && fs::exists(folder / "ca-key.pem", ignored);
}

base::Status MakeCertificate(const fs::path& folder, const CertificateRequest& request) {
  if (auto ok = CheckRequest(request); !ok) return ok;
  const auto authority = ReadCertificate(folder / "ca.pem");
  if (!authority) return base::Fail(authority.error());
  const auto authority_key = ReadKey(folder / "ca-key.pem");
  if (!authority_key) return base::Fail(authority_key.error());
  const Key key(EVP_EC_gen("P-256"));
  const Certificate made = key ? Begin(key.get(), request.name, request.validity) : nullptr;
  if (!made) return Failed();
  X509_set_issuer_name(made.get(), X509_get_subject_name(authority->get()));
  X509* const issuer = authority->get();
  const std::string names = AlternativeNames(request.hosts);
  if (!Extend(made.get(), issuer, NID_basic_constraints, "critical,CA:FALSE") ||
      !Extend(made.get(), issuer, NID_key_usage, "critical,digitalSignature") ||
      !Extend(made.get(), issuer, NID_ext_key_usage, "serverAuth,clientAuth") ||
      !Extend(made.get(), issuer, NID_authority_key_identifier, "keyid:always") ||
      (!names.empty() && !Extend(made.get(), issuer, NID_subject_alt_name, names)) ||
      X509_sign(made.get(), authority_key->get(), EVP_sha256()) == 0) {
    return Failed();
  }
  return Write(folder, request.name, made.get(), key.get());
}

namespace {

base::Status CheckDates(const X509* certificate, const fs::path& path) {
  if (X509_cmp_current_time(X509_get0_notAfter(certificate)) < 0) {
    return base::Fail(ErrorCode::kInvalidArgument,
                      "this certificate has expired; make a new one with `gsv certificates make`",
                      path);
  }
  if (X509_cmp_current_time(X509_get0_notBefore(certificate)) > 0) {
    return base::Fail(ErrorCode::kInvalidArgument,
                      "this certificate is not valid yet; check this machine's clock", path);
  }
  return {};
}

}  // namespace

base::Status CheckKeyPair(const fs::path& certificate, const fs::path& key) {
  const auto read = ReadCertificate(certificate);
  if (!read) return base::Fail(read.error());
  const auto read_key = ReadKey(key);
  if (!read_key) return base::Fail(read_key.error());
  if (X509_check_private_key(read->get(), read_key->get()) != 1) {
    return base::Fail(ErrorCode::kInvalidArgument,
                      "this key does not belong to the certificate " + certificate.string(), key);
  }
  return CheckDates(read->get(), certificate);
}

base::Status CheckAuthority(const fs::path& certificate) {
  const auto read = ReadCertificate(certificate);
  if (!read) return base::Fail(read.error());
  if (X509_check_ca(read->get()) == 0) {
    return base::Fail(ErrorCode::kInvalidArgument, "this is not the certificate of an authority",
                      certificate);
  }
  return CheckDates(read->get(), certificate);
}

}  // namespace gsv::tls
