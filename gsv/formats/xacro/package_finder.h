// Finds $(find package): the folder of a ROS package without a ROS installation.
#pragma once

#include <filesystem>
#include <string>

#include "gsv/base/error.h"
#include "gsv/formats/files/resource_finder.h"

namespace gsv::formats::xacro {

// A folder of that name where the finder looks for package://NAME; else, up to five folders above
// the naming file, a folder whose package.xml has that name, or one beside it.
base::Result<std::filesystem::path> FindPackage(const std::string& name,
                                                const std::filesystem::path& naming_file,
                                                const ResourceFinder& finder);

}  // namespace gsv::formats::xacro
