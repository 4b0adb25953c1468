// Options for reading worlds and models.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/formats/files/read_limits.h"
#include "gsv/model/world_description.h"

namespace gsv::formats {

// Checks a sensor. Returns an error for invalid parameters, and kNotFound for an unknown type.
using SensorCheck = std::function<base::Status(const model::SensorDescription&)>;

// Options of a ModelLibrary.
struct ReadOptions {
  std::vector<std::filesystem::path> model_path;  // see --model-path
  bool allow_absolute_paths = true;               // whether names in files may be absolute paths
  // Drives that replace the drives of models. The key is the name with which
  // ModelLibrary::ReadModel() reads the model. The value has the form of model/drive_choice.h.
  std::map<std::string, std::string> drives;
  ReadLimits limits;
  // Whether to check SDFormat's rules on names and references (gsv/formats/support/naming_rules.h).
  // Only the files that the caller passes to ReadWorld() and ReadModel() are checked, and not the
  // files that they include. Each broken rule is added as an error. Files are repaired whether or
  // not they are checked.
  bool check_rules = false;
  SensorCheck check_sensor;  // if it is empty, sensors are not checked
};

}  // namespace gsv::formats
