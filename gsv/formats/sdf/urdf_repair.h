// Repairs a robot in URDF before urdfdom and libsdformat read it. urdfdom refuses the whole robot
// for one error, and libsdformat drops links without mass, with their joints, shapes and sensors.
#pragma once

#include <filesystem>

#include <tinyxml2.h>

#include "gsv/base/error.h"

namespace gsv::formats {

// Changes the elements below <robot>. Each change gives a warning:
//   links         without mass that can move get 0.1 kg, unless they are fixed to a link with mass.
//                 If several links have equal names, only the first is read
//   joints        that do not connect two links of the robot, or that close a loop, are left out.
//                 Joints of unknown type become fixed
//   floating      and planar joints: if one connects the robot to an empty root link such as
//                 `world`, the robot can move freely. All other such joints become fixed
//   trees         if joints do not connect all links, only the largest tree of links is read
//   parts         see urdf_part_repair.h
void RepairUrdf(tinyxml2::XMLElement& robot, const std::filesystem::path& file,
                base::Problems& problems);

}  // namespace gsv::formats
