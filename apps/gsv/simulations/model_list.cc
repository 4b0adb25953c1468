#include "apps/gsv/simulations/model_list.h"

#include <fstream>
#include <iterator>
#include <set>

#include "gsv/model/drive_guess.h"

namespace gsv::app {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMaxFileBytes = 4u << 20;

bool IsModelFile(const fs::path& file) {
  return file.extension() == ".sdf" || file.extension() == ".urdf" || file.extension() == ".xacro";
}

bool IsRobot(const model::Model& model) {
  return model.drive || !model.control_systems.empty() ||
         model::GuessDrive(model).kind != model::DriveKind::kNone;
}

// Whether the model may have a drive: an SDF file with a <plugin>, or a URDF file, which may have
// other elements for a drive. This quick search avoids that all models of a library are parsed.
bool MayHaveDrive(const fs::path& folder) {
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
    const fs::path& file = entry.path();
    if (!IsModelFile(file) || !entry.is_regular_file(ignored)) continue;
    if (entry.file_size(ignored) > kMaxFileBytes) continue;
    std::ifstream stream(file, std::ios::binary);
    const std::string text(std::istreambuf_iterator<char>(stream), {});
    if (text.find("<plugin") != std::string::npos || file.extension() != ".sdf") return true;
  }
  return false;
}

}  // namespace

std::vector<std::string> FindRobotModels(formats::ModelLibrary& library,
                                         const std::vector<fs::path>& folders) {
  std::set<std::string> names;
  for (const fs::path& folder : folders) {
    std::error_code ignored;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
      if (!entry.is_directory(ignored) || !MayHaveDrive(entry.path())) continue;
      base::Problems problems;  // these problems are reported when the model is used
      const auto model = library.ReadModel(entry.path(), problems);
      if (model && IsRobot(**model)) names.insert(entry.path().filename());
    }
  }
  return {names.begin(), names.end()};
}

}  // namespace gsv::app
