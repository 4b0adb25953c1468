// Where the parts of this installation lie.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gsv::app {

std::filesystem::path ProgramPath();  // this executable
std::filesystem::path ProgramFolder();
std::filesystem::path ShareFolder();  // worlds, models, the viewer

// A world as given: a path, or the name of one of ours ("office").
std::string ResolveWorld(const std::string& world);

// "wander --no-pictures" as its words, cut at blanks.
std::vector<std::string> SplitWords(const std::string& text);

}  // namespace gsv::app
