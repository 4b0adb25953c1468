#include "gsv/formats/xacro/package_finder.h"

#include <algorithm>
#include <optional>
#include <system_error>
#include <vector>

#include <tinyxml2.h>

#include "gsv/base/sorting.h"

namespace gsv::formats::xacro {
namespace {

namespace fs = std::filesystem;

constexpr int kParents = 5;
constexpr std::size_t kMaxNeighbours = 1000;

bool IsPackage(const fs::path& folder, const std::string& name) {
  std::error_code ignored;
  const fs::path manifest = folder / "package.xml";
  if (!fs::is_regular_file(manifest, ignored)) return false;
  tinyxml2::XMLDocument document;
  if (document.LoadFile(manifest.c_str()) != tinyxml2::XML_SUCCESS) return false;
  const auto* root = document.RootElement();
  const auto* element = root == nullptr ? nullptr : root->FirstChildElement("name");
  const char* text = element == nullptr ? nullptr : element->GetText();
  return text != nullptr && name == text;
}

std::optional<fs::path> NeighbourNamed(const fs::path& folder, const std::string& name) {
  std::vector<fs::path> neighbours;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (neighbours.size() >= kMaxNeighbours) break;
    if (entry.is_directory(error)) neighbours.push_back(entry.path());
  }
  base::Sort(neighbours);
  const auto found = std::find_if(neighbours.begin(), neighbours.end(),
                                  [&](const fs::path& each) { return IsPackage(each, name); });
  return found == neighbours.end() ? std::nullopt : std::optional(*found);
}

}  // namespace

base::Result<fs::path> FindPackage(const std::string& name, const fs::path& naming_file,
                                   const ResourceFinder& finder) {
  auto found = finder.Find("package://" + name, naming_file);
  std::error_code ignored;
  if (found && fs::is_directory(*found, ignored)) return fs::absolute(*found, ignored);
  fs::path folder = fs::absolute(naming_file, ignored).lexically_normal().parent_path();
  for (int level = 0; level < kParents && folder.has_relative_path(); ++level) {
    if (IsPackage(folder, name)) return folder;
    if (auto neighbour = NeighbourNamed(folder, name)) return *neighbour;
    folder = folder.parent_path();
  }
  return base::Fail(
      base::ErrorCode::kNotFound,
      "cannot find the package \"" + name +
          "\" beside the file or on the model path; add its folder with --model-path");
}

}  // namespace gsv::formats::xacro
