// A fan: the rays of one row of a lidar, from one point and at evenly spaced azimuths.
#pragma once

#include <span>

#include "gsv/geometry/pose.h"

namespace gsv::sensing {

// Ray i has the azimuth first + i * step about the z axis of the fan's frame, counted from the x
// axis. All rays have the same elevation over the xy plane.
struct Fan {
  geometry::Pose world_from_fan;                  // its position is the origin of all rays
  double first = 0, step = 0;                     // rad; step > 0 unless there is only one ray
  double elevation = 0;                           // rad
  double max_distance = 0;                        // m
  std::span<const geometry::Vector3> directions;  // unit vectors along the rays, in the fan's frame
};

}  // namespace gsv::sensing
