// Where the parts of this installation lie.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "gsv/base/error.h"

namespace gsv::app {

std::filesystem::path ProgramPath();  // this executable
std::filesystem::path ProgramFolder();
std::filesystem::path ShareFolder();  // worlds, models, the viewer

// The worlds that ship with gsv, by name: "maze", "office"...
std::vector<std::string> OurWorlds();

// A world's file as somebody names it: a path, or the name of one of ours. Fails with kNotFound,
// and the names there are, where a bare name is neither; of a path that leads nowhere the reader
// complains.
base::Result<std::string> FindWorld(const std::string& world);

// A warning for each folder of a model path that is not there, or is no folder.
base::Problems CheckModelPath(const std::vector<std::string>& model_path);

// "wander --no-pictures" as its words, cut at blanks.
std::vector<std::string> SplitWords(const std::string& text);

}  // namespace gsv::app
