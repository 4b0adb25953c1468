// An UploadFolder stores uploaded files on disk until the server ends. A set has files that belong
// together, such as a world with its meshes and models.
//
// Input    untrusted names. Each set has its own folder, which no name can leave.
// Threads  any; each call writes one file.
// Bounded  see UploadLimits.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gsv/base/mutex.h"
#include "gsv/base/temporary_folder.h"

namespace gsv::gateway::uploads {

// The limits of an UploadFolder.
struct UploadLimits {
  std::size_t files = 5'000;                     // maximum number of files of all sets
  std::uint64_t bytes = std::uint64_t{1} << 30;  // maximum size of all sets
  std::size_t depth = 12;                        // maximum number of names in a path
};

// Stores uploaded files until the server ends.
class UploadFolder {
 public:
  explicit UploadFolder(const UploadLimits& limits = {}) : limits_(limits) {}

  // Creates a set and returns its name.
  base::Result<std::string> Begin();

  // Writes a file into a set. `path` has its folders and its name. Returns its path on disk.
  // kInvalidArgument: invalid name; kNotFound: unknown set; kUnavailable: limit reached.
  base::Result<std::filesystem::path> Put(const std::string& set,
                                          const std::vector<std::string>& path,
                                          std::string_view content);

 private:
  const UploadLimits limits_;
  base::Mutex mutex_;
  std::optional<base::TemporaryFolder> folder_ GSV_GUARDED_BY(mutex_);  // created on demand
  std::uint64_t sets_ GSV_GUARDED_BY(mutex_) = 0;                       // number of sets so far
  std::size_t files_ GSV_GUARDED_BY(mutex_) = 0;    // number of files in all sets
  std::uint64_t bytes_ GSV_GUARDED_BY(mutex_) = 0;  // size of all files
};

}  // namespace gsv::gateway::uploads
