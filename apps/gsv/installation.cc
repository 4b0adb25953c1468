#include "apps/gsv/installation.h"

#include <iterator>
#include <sstream>

namespace gsv::app {

namespace fs = std::filesystem;

fs::path ProgramPath() {
  std::error_code ignored;
  return fs::read_symlink("/proc/self/exe", ignored);
}

fs::path ProgramFolder() { return ProgramPath().parent_path(); }

fs::path ShareFolder() { return ProgramFolder().parent_path() / "share" / "gsv"; }

std::string ResolveWorld(const std::string& world) {
  std::error_code ignored;
  if (fs::exists(world, ignored) || world.find('/') != std::string::npos) return world;
  for (const char* suffix : {".sdf", ""}) {
    const fs::path ours = ShareFolder() / "worlds" / (world + suffix);
    if (fs::is_regular_file(ours, ignored)) return ours;
  }
  return world;
}

std::vector<std::string> SplitWords(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

}  // namespace gsv::app
