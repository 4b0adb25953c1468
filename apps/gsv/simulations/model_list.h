// Lists the available models that can be robots.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "gsv/formats/sdf_reader.h"

namespace gsv::app {

// Returns the sorted names of the models in these folders that have a drive. The function reads all
// models that may have a drive, so the first call takes some time. The library caches these models.
std::vector<std::string> FindRobotModels(formats::ModelLibrary& library,
                                         const std::vector<std::filesystem::path>& folders);

}  // namespace gsv::app
