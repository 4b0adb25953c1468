// Serves the viewer's files and the documentation, each from one directory.
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

// Serves the viewer's files from one directory.
class StaticFiles {
 public:
  // `root` may be empty or missing. Then "/" explains how to build the viewer's files.
  explicit StaticFiles(const std::filesystem::path& root);

  // Returns a file; "/" is index.html. Returns 404 for missing and hidden files, and for paths that
  // leave the root (by "..", a separator inside a segment, or a symbolic link).
  Response Get(const Request& request) const;

  // Returns the file at the path below the root that consists of these segments, or index.html if
  // there are none. Returns status 304 without the file if `if_none_match` has the file's entity
  // tag, and nullopt where Get() would answer 404.
  std::optional<Response> Find(const std::vector<std::string>& segments,
                               const std::string& if_none_match) const;

  // Returns the routes. They need no permission: the files are public, and the page asks for the
  // token. The handlers are valid during the lifetime of this object.
  std::vector<Route> Routes() const;

 private:
  // Returns a page that explains how to build the viewer's files.
  Response Explain() const;

  std::filesystem::path given_;  // the root as the user gave it
  std::filesystem::path root_;   // canonical path; empty if the directory does not exist
};

// The documentation site at "/docs/", as tools/make_docs builds it.
class Documentation {
 public:
  // `root` may be empty or missing. Then "/docs/" explains how to build the documentation.
  explicit Documentation(const std::filesystem::path& root) : files_(root) {}

  // "/docs/" is index.html, and "/docs" redirects to it. Returns 404 like StaticFiles.
  Response Get(const Request& request) const;

  // Returns the routes, which need no permission. The handlers are valid during the lifetime of
  // this object.
  std::vector<Route> Routes() const;

 private:
  const StaticFiles files_;
};

// Returns the content type by the file extension (in any case) or "application/octet-stream".
std::string_view ContentTypeOf(const std::filesystem::path& file);

}  // namespace gsv::gateway
