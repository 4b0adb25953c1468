// How worlds and models are to be read.
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

// What is wrong with a sensor, if anything: kNotFound when nobody knows its type.
using SensorCheck = std::function<base::Status(const model::SensorDescription&)>;

struct ReadOptions {
  std::vector<std::filesystem::path> model_path;  // as of --model-path
  bool allow_absolute_paths = true;               // in the names that files contain
  // Of models that ModelLibrary::ReadModel() reads, by their names: drives as
  // model/drive_choice.h has them, which replace their own.
  std::map<std::string, std::string> drives;
  ReadLimits limits;
  // Errors as well for each rule of SDFormat that a named file breaks by its names and references,
  // see gsv/formats/support/naming_rules.h. Reading repairs these; a check refuses them.
  bool check_rules = false;
  SensorCheck check_sensor;  // may be empty: then a sensor's parameters are taken as they are
};

}  // namespace gsv::formats
