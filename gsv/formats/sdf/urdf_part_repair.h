// Repairs the parts of a robot's links and joints in URDF.
#pragma once

#include <filesystem>

#include <tinyxml2.h>

#include "gsv/base/error.h"

namespace gsv::formats {

// Changes values in <link>, <joint>, <material> and <gazebo> elements below <robot> that urdfdom
// would refuse. Each change gives a warning:
//   numbers       that are invalid get the default of the attribute
//   shapes        without a size or file, or of an unknown kind: their visual or collision is left
//                 out
//   inertias      without a mass are left out, as if the link had none. Missing moments become the
//                 moments of a ball
//   limits        that are missing: a revolute joint turns freely, other joints have no limit
//   materials     that nothing defines, or that are defined twice, are left out
void RepairUrdfParts(tinyxml2::XMLElement& robot, const std::filesystem::path& file,
                     base::Problems& problems);

// Adds an <inertial> of this mass in kilograms, with the moments of a ball of 5 cm radius.
void AddInertial(tinyxml2::XMLElement& link, double mass);

}  // namespace gsv::formats
