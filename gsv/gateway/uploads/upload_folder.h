// Files that people drop onto the page, on this machine's disk until the server ends: worlds, with
// the meshes and models that they name.
//
// Input    hostile: names come from browsers. A set's files lie in a folder of their own, which no
//          name leads out of.
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

struct UploadLimits {
  std::size_t files = 5'000;                     // in all
  std::uint64_t bytes = std::uint64_t{1} << 30;  // in all
  std::size_t depth = 12;                        // of folders
};

class UploadFolder {
 public:
  explicit UploadFolder(const UploadLimits& limits = {}) : limits_(limits) {}

  // Begins a set; gives its name.
  base::Result<std::string> Begin();

  // Writes a file into a set. `path` is its folders and its name. Gives where it lies.
  // kInvalidArgument: a name that cannot be used; kNotFound: no such set; kUnavailable: there is no
  // room left.
  base::Result<std::filesystem::path> Put(const std::string& set,
                                          const std::vector<std::string>& path,
                                          std::string_view content);

 private:
  const UploadLimits limits_;
  base::Mutex mutex_;
  std::optional<base::TemporaryFolder> folder_ GSV_GUARDED_BY(mutex_);  // made when it is needed
  std::uint64_t sets_ GSV_GUARDED_BY(mutex_) = 0;
  std::size_t files_ GSV_GUARDED_BY(mutex_) = 0;
  std::uint64_t bytes_ GSV_GUARDED_BY(mutex_) = 0;
};

}  // namespace gsv::gateway::uploads
