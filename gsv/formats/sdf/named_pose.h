// A named frame of a world, with its pose.
#pragma once

#include <string>

#include "gsv/geometry/pose.h"

namespace gsv::formats {

// A <frame> of a world.
struct NamedPose {
  std::string name;
  geometry::Pose world_from_pose;
};

}  // namespace gsv::formats
