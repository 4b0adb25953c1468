// A folder of one's own for as long as it is needed.
//
// Threads  one owner.
#pragma once

#include <filesystem>
#include <string>
#include <utility>

#include "gsv/base/error.h"

namespace gsv::base {

class TemporaryFolder {
 public:
  // Makes a folder for this user alone, below the system's folder for temporary files, whose name
  // begins with `prefix`.
  static Result<TemporaryFolder> Make(const std::string& prefix);

  TemporaryFolder(TemporaryFolder&& other) noexcept : path_(std::exchange(other.path_, {})) {}
  TemporaryFolder& operator=(TemporaryFolder&& other) noexcept {
    std::swap(path_, other.path_);
    return *this;
  }
  // Removes it with all that is in it.
  ~TemporaryFolder();

  const std::filesystem::path& path() const { return path_; }

 private:
  explicit TemporaryFolder(std::filesystem::path path) : path_(std::move(path)) {}

  std::filesystem::path path_;
};

}  // namespace gsv::base
