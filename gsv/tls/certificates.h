// A small certificate authority: for a laboratory's servers, and for those who may call them.
//
// Files    PEM. A key is readable by its owner alone, and nothing that is there is written over.
// Keys     elliptic, P-256; signatures with SHA-256. X.509 version 3 (RFC 5280).
// Errors   kInvalidArgument: a name that cannot stand in a file's; kUnavailable: a file that cannot
//          be written or read, or is there already.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "gsv/base/error.h"

namespace gsv::tls {

// Counted from now.
struct Validity {
  std::chrono::seconds begins{-300};  // clocks differ
  std::chrono::seconds ends{365 * 86'400};
};

struct CertificateRequest {
  std::string name;                // whose it is: letters, digits and -._
  std::vector<std::string> hosts;  // names and addresses under which a server is called
  Validity validity{};
};

// FOLDER/ca.pem and ca-key.pem. The folder is made if it is not there, for its owner alone.
base::Status MakeAuthority(const std::filesystem::path& folder, const Validity& validity);
bool HasAuthority(const std::filesystem::path& folder);

// FOLDER/NAME.pem and NAME-key.pem, signed by the folder's authority, good for serving and calling.
base::Status MakeCertificate(const std::filesystem::path& folder,
                             const CertificateRequest& request);

// Whether a server can use them: both can be read, belong together and are valid now. The sentence
// names the file.
base::Status CheckKeyPair(const std::filesystem::path& certificate,
                          const std::filesystem::path& key);
// Whether it holds certificates that others can be checked against.
base::Status CheckAuthority(const std::filesystem::path& certificate);

}  // namespace gsv::tls
