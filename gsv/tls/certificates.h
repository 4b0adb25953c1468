// A small certificate authority for the servers of a laboratory and their clients.
//
// Files    PEM. Only the owner can read a key. Existing files are never overwritten.
// Keys     elliptic, P-256; signatures with SHA-256. X.509 version 3 (RFC 5280).
// Errors   kInvalidArgument: an invalid name or host, or a certificate or key that a check refuses;
//          kUnavailable: a file cannot be written or read, or exists already, or OpenSSL fails.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "gsv/base/error.h"

namespace gsv::tls {

// The period in which a certificate is valid, relative to now.
struct Validity {
  std::chrono::seconds begins{-300};  // begins 5 minutes earlier, to tolerate clocks that differ
  std::chrono::seconds ends{365 * 86'400};  // ends after 365 days
};

// The content of a certificate to make.
struct CertificateRequest {
  std::string name;                // the name in the certificate: letters, digits and -._
  std::vector<std::string> hosts;  // host names and addresses of the server
  Validity validity{};
};

// Writes FOLDER/ca.pem and FOLDER/ca-key.pem. A missing folder is created with access only for its
// owner.
base::Status MakeAuthority(const std::filesystem::path& folder, const Validity& validity);
bool HasAuthority(const std::filesystem::path& folder);

// Writes FOLDER/NAME.pem and FOLDER/NAME-key.pem. The authority in the folder signs the
// certificate, which is valid for servers and clients.
base::Status MakeCertificate(const std::filesystem::path& folder,
                             const CertificateRequest& request);

// Checks that a server can use certificate and key: both are readable, belong together and are
// valid now. The error names the file.
base::Status CheckKeyPair(const std::filesystem::path& certificate,
                          const std::filesystem::path& key);
// Checks that the first certificate in the file belongs to an authority and is valid now.
base::Status CheckAuthority(const std::filesystem::path& certificate);

}  // namespace gsv::tls
