// Converts a simulation's state to ROS 2 messages.
//
// Frames  see gsv/sensing/frames.h.
#pragma once

#include <cstddef>
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

inline constexpr std::size_t kMaxContacts = 1000;  // maximum number of contacts in a message

// `poses` must be the result of PosesOf().
messages::gsv_msgs::Poses PosesMessage(const world::Snapshot& snapshot,
                                       std::span<const geometry::Pose> poses);

messages::geometry_msgs::TransformStamped StampedTransform(std::string_view parent,
                                                           std::string child, base::SimTime time,
                                                           const geometry::Pose& parent_from_child);
// Returns "robot/base_link", or the name of a body that is not a robot.
std::string BodyFrame(const world::Body& body);
// Returns the frame of a link that moves relative to its body. The result is the link's name,
// changed if the body's own frame has the same name.
std::string LinkFrame(const world::Body& body, const model::Link& link);

// Returns the transforms map → body for entries of bodies, and body → link for entries of links.
messages::tf2_msgs::TFMessage TransformsMessage(const world::Snapshot& snapshot,
                                                const std::vector<PoseEntry>& list);
// Changes the stamps and transforms in `message` to the time and poses of `snapshot`. `message`
// must be a result of TransformsMessage() for the same list and the same layout. `poses` must be
// the result of PosesOf().
void UpdateTransforms(const world::Snapshot& snapshot, const std::vector<PoseEntry>& list,
                      std::span<const geometry::Pose> poses,
                      messages::tf2_msgs::TFMessage& message);

messages::gsv_msgs::Contact ContactMessage(const world::Snapshot& snapshot,
                                           const world::Contact& contact);
// Returns the contacts of the snapshot's last step, at most kMaxContacts.
messages::gsv_msgs::Contacts ContactsMessage(const world::Snapshot& snapshot);

// Returns the command that an actuator applies. The device must have a command.
messages::gsv_msgs::ActuatorCommand ActuatorMessage(const world::DeviceState& device,
                                                    const world::State& state);

messages::gsv_msgs::Transmission TransmissionMessage(const world::Snapshot& snapshot,
                                                     const world::Transmission& transmission);

// Returns the last command of a robot's drive. `state` must be at least one step later than the
// command.
messages::gsv_msgs::Command CommandMessage(const std::string& robot, const world::DriveState& drive,
                                           const world::State& state);

}  // namespace gsv::presentation
