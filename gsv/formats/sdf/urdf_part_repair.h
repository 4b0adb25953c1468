// Repairs the parts of a robot's links and joints in URDF.
#pragma once

#include <filesystem>

#include <tinyxml2.h>

#include "gsv/base/error.h"

namespace gsv::formats {

// Changes what urdfdom would refuse in <link>, <joint>, <material> and <gazebo> elements below
// <robot>. Each change is a warning:
//   numbers       that are none: the default of the attribute
//   shapes        without a size or file, or of an unknown kind: their visual or collision is left
//                 out
//   inertias      without a mass are left out, to be treated as a link without one; moments that are
//                 missing are those of a ball
//   limits        that are missing: a revolute joint turns freely, others have no limit
//   materials     that nothing defines, or that are defined twice, are left out
void RepairUrdfParts(tinyxml2::XMLElement& robot, const std::filesystem::path& file,
                     base::Problems& problems);

// Adds an <inertial> of so many kilograms with the moments of a ball of 5 cm radius.
void AddInertial(tinyxml2::XMLElement& link, double mass);

}  // namespace gsv::formats
