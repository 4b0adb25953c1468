// A file of this process, for readers that do not take bytes: written for each input.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include "gsv/base/temporary_folder.h"

namespace gsv::formats {

// In its own folder, two below the temporary one, so that names that leave the folder find nothing.
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
