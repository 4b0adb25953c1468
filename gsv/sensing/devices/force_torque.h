// The sensor type "force_torque" of a joint, as in SDFormat: the force and torque that the joint
// transmits.
//
// Frame       the frame that the parameter `frame` names. The torque is about the joint's origin.
// Parameters  (with their default values)
//   frame ("child")         "child", "parent" or "sensor": the axes of the reading
//   measure_direction ("child_to_parent")
//                           "child_to_parent": the wrench that the child exerts on the parent;
//                           "parent_to_child": the wrench that the parent exerts on the child
//   force.{x,y,z}.noise (N), torque.{x,y,z}.noise (N m)   see noise.h
// Model       see joint_wrench.h. The sensor belongs to the joint whose child is the sensor's link.
// Readings    values {force x, y, z (N), torque x, y, z (N m)}. As a message:
//             geometry_msgs/WrenchStamped.
#pragma once

#include "gsv/sensing/registry.h"

namespace gsv::sensing {

SensorType ForceTorqueType();

}  // namespace gsv::sensing
