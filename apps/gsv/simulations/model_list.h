// Which models there are, and which of them can be robots.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "gsv/formats/sdf_reader.h"

namespace gsv::app {

// The names of the models in these folders that have a drive, in order, each once. Reads those that
// may have one, so the first call takes its time; the library keeps what it has read.
std::vector<std::string> FindRobotModels(formats::ModelLibrary& library,
                                         const std::vector<std::filesystem::path>& folders);

// The names of all models in these folders, in order, each once; nothing is read.
std::vector<std::string> FindModels(const std::vector<std::filesystem::path>& folders);

}  // namespace gsv::app
