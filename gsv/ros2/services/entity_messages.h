// Converts poses and states of bodies to ROS 2 messages.
#pragma once

#include "gsv/base/error.h"
#include "gsv/geometry/pose.h"
#include "gsv/geometry/triangle_mesh.h"
#include "gsv/messages/simulation_interfaces.h"
#include "gsv/world/snapshot.h"

namespace gsv::ros2 {

// The frame in which all poses are given.
inline constexpr const char* kEntityFrame = "world";

// Returns a body's state in the frame "world". Velocities and accelerations are those of the body's
// origin.
messages::simulation_interfaces::EntityState StateOf(const world::Snapshot& snapshot, int body);

messages::geometry_msgs::Pose MessageOf(const geometry::Pose& pose);

// Converts a box to two corners: first the corner with the largest coordinates (x, y and z), then
// the corner with the smallest coordinates.
messages::simulation_interfaces::Bounds BoxOf(const geometry::Bounds& bounds);

// Returns the pose in an untrusted message. An orientation of zeros means no rotation. Fails with
// kInvalidArgument for numbers that are not finite, for an orientation that is not a unit
// quaternion (within 1 %), and for frames other than "world" and "".
base::Result<geometry::Pose> PoseIn(const std::string& frame,
                                    const messages::geometry_msgs::Pose& pose);

// Whether a pose has z = 0 and no roll and no pitch. The default pose of a ROS 2 message is such a
// pose. A body that is placed at such a pose is put on the floor.
bool StandsOnTheFloor(const geometry::Pose& pose);

}  // namespace gsv::ros2
