#include "apps/gsv/machine/installation.h"

#include <iterator>
#include <sstream>

#include "gsv/base/sorting.h"
#include "gsv/base/spelling.h"
#include "gsv/formats/xacro/arguments.h"

namespace gsv::app {

namespace fs = std::filesystem;

fs::path ProgramPath() {
  std::error_code ignored;
  return fs::read_symlink("/proc/self/exe", ignored);
}

fs::path ProgramFolder() { return ProgramPath().parent_path(); }

fs::path ShareFolder() { return ProgramFolder().parent_path() / "share" / "gsv"; }

std::vector<std::string> BuiltInWorlds() {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const fs::directory_entry& entry :
       fs::directory_iterator(ShareFolder() / "worlds", ignored)) {
    if (entry.path().extension() == ".sdf") names.push_back(entry.path().stem());
  }
  base::Sort(names);
  return names;
}

base::Result<std::string> FindWorld(const std::string& world) {
  std::error_code ignored;
  if (fs::exists(formats::xacro::FilePart(world), ignored) || world.find('/') != std::string::npos)
    return world;
  for (const char* suffix : {".sdf", ""}) {
    const fs::path ours = ShareFolder() / "worlds" / (world + suffix);
    if (fs::is_regular_file(ours, ignored)) return ours;
  }
  std::string names;
  const std::vector<std::string> ours = BuiltInWorlds();
  for (const std::string& name : ours) names += (names.empty() ? "" : ", ") + name;
  return base::Fail(base::ErrorCode::kNotFound,
                    "there is no file or built-in world of this name; built-in worlds are " +
                        names + base::DidYouMean(world, ours),
                    world);
}

base::Problems CheckModelPath(const std::vector<std::string>& model_path) {
  base::Problems problems;
  for (const std::string& folder : model_path) {
    std::error_code ignored;
    if (fs::is_directory(folder, ignored)) continue;
    problems.push_back({base::Problem::Severity::kWarning,
                        fs::exists(folder, ignored)
                            ? "is not a folder; it is not searched for models"
                            : "there is no such folder",
                        "--model-path " + folder});
  }
  return problems;
}

std::vector<std::string> SplitWords(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

}  // namespace gsv::app
