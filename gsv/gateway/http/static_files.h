// The viewer's files and the documentation, each served from one directory and nothing outside it.
//
// Threads  const members may run concurrently.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gsv/gateway/http/route.h"

namespace gsv::gateway {

class StaticFiles {
 public:
  // `root` may be empty or absent: then "/" explains what is missing.
  explicit StaticFiles(const std::filesystem::path& root);

  // "/" is index.html. 404 for what is not there, is hidden, or leads out of the root (by "..", a
  // separator inside a segment, or a symbolic link).
  Response Get(const Request& request) const;

  // The file that the segments name below the root, or 304 where `if_none_match` names its entity
  // tag. No segments name index.html. Empty where Get() answers 404.
  std::optional<Response> Find(const std::vector<std::string>& segments,
                               const std::string& if_none_match) const;

  // They take no permission: the files hold no secret, and ask for the token. The handlers live as
  // long as this.
  std::vector<Route> Routes() const;

 private:
  Response Explain() const;

  std::filesystem::path given_;  // as the user wrote it
  std::filesystem::path root_;   // canonical; empty when there is no such directory
};

// The documentation site at "/docs/", as tools/make_docs builds it.
class Documentation {
 public:
  // `root` may be empty or absent: then "/docs/" says how to build it.
  explicit Documentation(const std::filesystem::path& root) : files_(root) {}

  // "/docs/" is index.html, and "/docs" leads there. 404 as of StaticFiles.
  Response Get(const Request& request) const;

  // They take no permission. The handlers live as long as this.
  std::vector<Route> Routes() const;

 private:
  const StaticFiles files_;
};

// By the file's extension, in any case; "application/octet-stream" for others.
std::string_view ContentTypeOf(const std::filesystem::path& file);

}  // namespace gsv::gateway
