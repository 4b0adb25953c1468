#pragma once

#include <cstdlib>
#include <filesystem>

namespace gsv::formats {

// The worlds and robots other people made, or nothing when they are not here.
inline std::filesystem::path RealFolder() {
  const char* folder = std::getenv("GSV_REAL_DIR");
  if (folder == nullptr || !std::filesystem::is_directory(folder)) return {};
  return folder;
}

}  // namespace gsv::formats
