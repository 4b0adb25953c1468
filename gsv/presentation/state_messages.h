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
#include "gsv/messages/visualization_msgs.h"
#include "gsv/model/sensor_description.h"
#include "gsv/presentation/pose_list.h"
#include "gsv/sensing/frames.h"
#include "gsv/sensing/registry.h"
#include "gsv/world/state.h"

namespace gsv::presentation {

using sensing::FrameOf;

messages::gsv_msgs::Poses PosesMessage(const world::Snapshot& snapshot,
                                       const std::vector<PoseEntry>& list);

// map → body for each entry that is a body, body → link for each that is a link.
messages::tf2_msgs::TFMessage TransformsMessage(const world::Snapshot& snapshot,
                                                const std::vector<PoseEntry>& list);

// Appends the transform of one sensor, against its robot or the moving link it sits on; of a camera
// that of its optical frame as well.
void AppendSensorTransform(const world::Layout& layout, int body,
                           const model::SensorDescription& sensor, const sensing::SensorType& type,
                           base::SimTime time, messages::tf2_msgs::TFMessage& message);

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

// The lines that are drawn of a reading, as pairs of points in the world: the beams of a type that
// is drawn as lines, and short dashes where beams end of one that is drawn as points and whose file
// asks for it (<visualize>). Nothing of other types.
bool HasLines(const sensing::SensorType& type, const model::SensorDescription& sensor);
void AppendLines(const sensing::SensorType& type, const model::SensorDescription& sensor,
                 const sensing::Reading& reading, const geometry::Pose& world_from_sensor,
                 std::vector<geometry::Vector3>& points_in_world);

// One robot's beams as pairs of points in the world.
messages::visualization_msgs::Marker BeamsMarker(const std::string& robot, base::SimTime time,
                                                 std::vector<geometry::Vector3> points_in_world);
// Takes a robot's beams away.
messages::visualization_msgs::Marker NoBeamsMarker(const std::string& robot, base::SimTime time);

}  // namespace gsv::presentation
