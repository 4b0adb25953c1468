// Converts models to URDF for robot_description. RViz on this machine can read their mesh files.
//
// Errors   if a mesh cannot be written, Of() fails for its model.
// Threads  one.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "gsv/base/error.h"
#include "gsv/base/temporary_folder.h"
#include "gsv/model/model.h"

namespace gsv::ros2 {

// The URDF of each model, cached.
class RobotDescriptions {
 public:
  // Returns the URDF of a model. Each model is converted once. Meshes have file:/// URIs in a
  // temporary folder, which is deleted with this object.
  base::Result<std::string> Of(const std::shared_ptr<const model::Model>& model);

 private:
  // Converts a model to URDF, and writes its meshes to the subfolder `name` of folder_.
  base::Result<std::string> Write(const model::Model& model, const std::string& name);

  std::optional<base::TemporaryFolder> folder_;                       // created with the first mesh
  std::map<std::shared_ptr<const model::Model>, std::string> texts_;  // the URDF by model
};

}  // namespace gsv::ros2
