#pragma once

#include <cstdlib>
#include <filesystem>

namespace gsv::formats {

// The worlds and robots of other authors, or nothing if they are not installed.
inline std::filesystem::path RealFolder() {
  const char* folder = std::getenv("GSV_REAL_DIR");
  if (folder == nullptr || !std::filesystem::is_directory(folder)) return {};
  return folder;
}

}  // namespace gsv::formats
