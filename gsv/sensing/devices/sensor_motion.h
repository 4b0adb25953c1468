// Computes the pose, velocity and acceleration of a sensor in the world.
//
// Frames     world axes.
// Exactness  velocities are exact at the sampled instant. Accelerations of the body and of the joints
//            are means over the last step. Both include the motion of the joints (link_motion.h).
#pragma once

#include "gsv/sensing/sensor.h"

namespace gsv::sensing {

// The motion of a sensor at one instant, in world axes.
struct SensorMotion {
  geometry::Pose world_from_sensor;
  geometry::Vector3 velocity;          // m/s
  geometry::Vector3 angular_velocity;  // rad/s
  geometry::Vector3 acceleration;      // m/s²
};

// Returns the motion of a sensor at the instant of the sampling.
SensorMotion MotionOf(const Sampling& sampling, const model::SensorDescription& description);

}  // namespace gsv::sensing
