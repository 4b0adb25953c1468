// Repairs a robot in URDF before urdfdom and libsdformat read it: urdfdom refuses the whole robot for
// one flaw, and libsdformat drops links without mass, with their joints, shapes and sensors.
#pragma once

#include <filesystem>

#include <tinyxml2.h>

#include "gsv/base/error.h"

namespace gsv::formats {

// Changes what is below <robot>. Each change is a warning:
//   links         that move by themselves and have no mass get one of 0.1 kg; those fixed to a link
//                 with mass need none. The first of two with one name is read
//   joints        that name no two links of the robot, or close a loop, are left out; of a type that
//                 is not known are fixed
//   floating      and planar joints: the robot is free when they hold its root to an empty link such
//                 as `world`; any others are fixed
//   trees         of several that no joint connects the largest is read
//   parts         see urdf_part_repair.h
void RepairUrdf(tinyxml2::XMLElement& robot, const std::filesystem::path& file,
                base::Problems& problems);

}  // namespace gsv::formats
