// Lists the available models, and those that can be robots.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "gsv/formats/sdf_reader.h"

namespace gsv::app {

// The sorted names of the models in these folders that have a drive. Reads models that may have
// one, so that the first call takes some time; the library keeps what it has read.
std::vector<std::string> FindRobotModels(formats::ModelLibrary& library,
                                         const std::vector<std::filesystem::path>& folders);

// The sorted names of all models in these folders; reads no model.
std::vector<std::string> FindModels(const std::vector<std::filesystem::path>& folders);

}  // namespace gsv::app
