// A temporary folder that its owner removes.
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
  // Creates a folder that only this user can access, below the system's folder for temporary files.
  // Its name begins with `prefix`.
  static Result<TemporaryFolder> Make(const std::string& prefix);

  TemporaryFolder(TemporaryFolder&& other) noexcept : path_(std::exchange(other.path_, {})) {}
  TemporaryFolder& operator=(TemporaryFolder&& other) noexcept {
    std::swap(path_, other.path_);
    return *this;
  }
  // Removes the folder and its content.
  ~TemporaryFolder();

  const std::filesystem::path& path() const { return path_; }

 private:
  explicit TemporaryFolder(std::filesystem::path path) : path_(std::move(path)) {}

  std::filesystem::path path_;
};

}  // namespace gsv::base
