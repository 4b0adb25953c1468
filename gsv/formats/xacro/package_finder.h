// Implements $(find package): finds the folder of a ROS package without a ROS installation.
#pragma once

#include <filesystem>
#include <string>

#include "gsv/base/error.h"
#include "gsv/formats/files/resource_finder.h"

namespace gsv::formats::xacro {

// Returns the folder that `finder` finds as package://NAME. If it finds none, searches for a folder
// whose package.xml has this name. The search covers the folder of `naming_file` (the file that
// contains the $(find)), the four folders above it, and the direct subfolders of these folders.
base::Result<std::filesystem::path> FindPackage(const std::string& name,
                                                const std::filesystem::path& naming_file,
                                                const ResourceFinder& finder);

}  // namespace gsv::formats::xacro
