#include "gsv/ros2/robot_descriptions.h"

#include <filesystem>
#include <utility>

#include "gsv/base/atomic_file.h"
#include "gsv/base/log.h"
#include "gsv/formats/urdf/urdf_writer.h"

namespace gsv::ros2 {
namespace {

namespace fs = std::filesystem;

// Stands in mesh URIs for "file://" and the path of the temporary folder. It is replaced when the
// folder exists. The folder is created only if the model has meshes.
constexpr const char* kPlaceholder = "gsv-ros2-meshes://";

void ReplaceAll(std::string& text, std::string_view from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos;
       at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
}

}  // namespace

base::Result<std::string> RobotDescriptions::Of(const std::shared_ptr<const model::Model>& model) {
  const auto known = texts_.find(model);
  if (known != texts_.end()) return known->second;
  auto text = Write(*model, "model" + std::to_string(texts_.size()));
  if (text) texts_[model] = *text;
  return text;
}

base::Result<std::string> RobotDescriptions::Write(const model::Model& model,
                                                   const std::string& name) {
  base::Problems problems;
  formats::Urdf urdf = formats::WriteUrdf(model, kPlaceholder, problems);
  for (const base::Problem& problem : problems) {
    spdlog::debug("robot_description of {}: {}", model.name, problem.Sentence());
  }
  if (urdf.meshes.empty()) return std::move(urdf.text);
  if (!folder_) {
    auto made = base::TemporaryFolder::Make("gsv-ros2-");
    if (!made) return base::Fail(made.error());
    folder_.emplace(*std::move(made));
  }
  const fs::path folder = folder_->path() / name;
  std::error_code error;
  fs::create_directory(folder, error);
  if (error) {
    return base::Fail(base::ErrorCode::kUnavailable, "cannot create the folder: " + error.message(),
                      folder.string());
  }
  for (const formats::UrdfMesh& mesh : urdf.meshes) {
    auto written = base::WriteAtomically(folder / mesh.file, mesh.stl, base::Durability::kProcess);
    if (!written) return base::Fail(written.error());
  }
  ReplaceAll(urdf.text, kPlaceholder, "file://" + folder.string() + "/");
  return std::move(urdf.text);
}

}  // namespace gsv::ros2
