// Writes a fuzz test's input to a file, for readers that need a file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include "gsv/base/temporary_folder.h"

namespace gsv::formats {

// Writes the file and returns its path. The file is in a subfolder of a temporary folder that
// contains nothing else. So a relative name that leads to the parent folder finds no other file.
inline std::filesystem::path ScratchFile(const std::string& name, const std::uint8_t* data,
                                         std::size_t size) {
  static const base::TemporaryFolder outer = base::TemporaryFolder::Make("gsv-fuzz").value();
  const std::filesystem::path folder = outer.path() / "scratch";
  std::filesystem::create_directory(folder);
  std::ofstream file(folder / name, std::ios::binary | std::ios::trunc);
  file.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  return folder / name;
}

}  // namespace gsv::formats
