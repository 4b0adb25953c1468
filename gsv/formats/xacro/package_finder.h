// Finds $(find package): the folder of a ROS package without a ROS installation.
#pragma once

#include <filesystem>
#include <string>

#include "gsv/base/error.h"
#include "gsv/formats/files/resource_finder.h"

namespace gsv::formats::xacro {

// Returns a folder with that name where the finder looks for package://NAME. Else a folder whose
// package.xml has that name: one of five folders above the naming file, or beside one.
base::Result<std::filesystem::path> FindPackage(const std::string& name,
                                                const std::filesystem::path& naming_file,
                                                const ResourceFinder& finder);

}  // namespace gsv::formats::xacro
