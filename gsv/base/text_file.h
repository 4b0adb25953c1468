// Reads a complete file as text.
#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace gsv::base {

// Returns the content of the file. Returns an empty text if the file cannot be read.
inline std::string ReadTextFile(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

}  // namespace gsv::base
