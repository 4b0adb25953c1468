// The folders of this installation.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "gsv/base/error.h"

namespace gsv::app {

std::filesystem::path ProgramPath();  // this executable
std::filesystem::path ProgramFolder();
std::filesystem::path ShareFolder();  // worlds, models, the viewer

// The names of the built-in worlds: "maze", "office"...
std::vector<std::string> BuiltInWorlds();

// The file of a world, given by path or by the name of a built-in world. Fails with kNotFound, and
// the known names, if a bare name is neither. Does not check whether a path exists; the reader
// reports that.
base::Result<std::string> FindWorld(const std::string& world);

// A warning for each entry of a model path that is not an existing folder.
base::Problems CheckModelPath(const std::vector<std::string>& model_path);

// Splits a command such as "wander --no-pictures" at blanks.
std::vector<std::string> SplitWords(const std::string& text);

}  // namespace gsv::app
