// A simulation's state as ROS 2 messages.
//
// Frames  see gsv/sensing/frames.h.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gsv/messages/cdr.h"
#include "gsv/messages/gsv_msgs.h"
#include "gsv/messages/tf2_msgs.h"
#include "gsv/presentation/pose_list.h"
#include "gsv/sensing/frames.h"
#include "gsv/world/state.h"

namespace gsv::presentation {

using sensing::FrameOf;

messages::gsv_msgs::Poses PosesMessage(const world::Snapshot& snapshot,
                                       const std::vector<PoseEntry>& list);

messages::geometry_msgs::TransformStamped StampedTransform(std::string_view parent,
                                                           std::string child, base::SimTime time,
                                                           const geometry::Pose& parent_from_child);
// "robot/base_link", or the name of a body that is no robot.
std::string BodyFrame(const world::Body& body);
// Of a link that moves against its body, whose own frame may have taken its name.
std::string LinkFrame(const world::Body& body, const model::Link& link);

// map → body for each entry that is a body, body → link for each that is a link.
messages::tf2_msgs::TFMessage TransformsMessage(const world::Snapshot& snapshot,
                                                const std::vector<PoseEntry>& list);

messages::gsv_msgs::Contact ContactMessage(const world::Snapshot& snapshot,
                                           const world::Contact& contact);

// The command that a device follows; it follows one.
messages::gsv_msgs::ActuatorCommand ActuatorMessage(const world::DeviceState& device,
                                                    const world::State& state);

messages::gsv_msgs::Transmission TransmissionMessage(const world::Snapshot& snapshot,
                                                     const world::Transmission& transmission);

// What a robot's drive was told last, as `state`, at least a step later, shows it.
messages::gsv_msgs::Command CommandMessage(const std::string& robot, const world::DriveState& drive,
                                           const world::State& state);

}  // namespace gsv::presentation
