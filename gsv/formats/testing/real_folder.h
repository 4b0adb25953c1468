// For tests: the folder of worlds and robots of other authors.
#pragma once

#include <cstdlib>
#include <filesystem>

namespace gsv::formats {

// Returns the folder of the worlds and robots of other authors; empty if they are not installed.
inline std::filesystem::path RealFolder() {
  const char* folder = std::getenv("GSV_REAL_DIR");
  if (folder == nullptr || !std::filesystem::is_directory(folder)) return {};
  return folder;
}

}  // namespace gsv::formats
