// A file of this process, for readers that take no bytes: written anew for each input.
#pragma once

#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "gsv/base/check.h"

namespace gsv::formats {

// In a folder of its own, two below the temporary one, so that names which climb out of it find
// nothing.
inline std::filesystem::path ScratchFile(const std::string& name, const std::uint8_t* data,
                                         std::size_t size) {
  static const std::filesystem::path folder = [] {
    std::string name_template =
        (std::filesystem::temp_directory_path() / "gsv-fuzz-XXXXXX").string();
    GSV_CHECK(mkdtemp(name_template.data()) != nullptr);
    static const std::filesystem::path made = name_template;
    std::atexit([] { std::filesystem::remove_all(made); });
    std::filesystem::create_directory(made / "scratch");
    return made / "scratch";
  }();
  std::ofstream file(folder / name, std::ios::binary | std::ios::trunc);
  file.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  return folder / name;
}

}  // namespace gsv::formats
