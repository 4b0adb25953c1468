// Finds the folders and files of this installation: programs, built-in worlds, models and the
// viewer.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "gsv/base/error.h"

namespace gsv::app {

std::filesystem::path ProgramPath();    // Returns the path of this executable.
std::filesystem::path ProgramFolder();  // Returns the folder of this executable.
std::filesystem::path ShareFolder();    // Returns the folder with worlds, models and the viewer.

// Returns the names of the built-in worlds, such as "maze" and "office".
std::vector<std::string> BuiltInWorlds();

// Returns the file of a world. `world` is a path or the name of a built-in world. Fails with
// kNotFound and the names of the built-in worlds if `world` is a bare name, but neither a file nor
// a built-in world. Does not check whether a path exists, because the reader of the file reports
// this error.
base::Result<std::string> FindWorld(const std::string& world);

// Returns a warning for each entry of a model path that is not an existing folder.
base::Problems CheckModelPath(const std::vector<std::string>& model_path);

// Splits a command such as "wander --no-pictures" at spaces.
std::vector<std::string> SplitWords(const std::string& text);

}  // namespace gsv::app
