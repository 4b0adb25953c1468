// Repairs a robot in URDF before urdfdom and libsdformat read it. urdfdom refuses the whole robot
// for one error, and libsdformat drops links without mass, with their joints, shapes and sensors.
#pragma once

#include <filesystem>

#include <tinyxml2.h>

#include "gsv/base/error.h"

namespace gsv::formats {

// Changes the elements below <robot>. Each change gives a warning:
//   links         that can move and have no mass get one of 0.1 kg; those fixed to a link with mass
//                 need none. The first of two with one name is read
//   joints        without two links of the robot, or that close a loop, are left out; joints of
//                 unknown type become fixed
//   floating      and planar joints: the robot can move freely if they connect its root to an empty
//                 link such as `world`; all others become fixed
//   trees         that no joint connects: the largest is read
//   parts         see urdf_part_repair.h
void RepairUrdf(tinyxml2::XMLElement& robot, const std::filesystem::path& file,
                base::Problems& problems);

}  // namespace gsv::formats
