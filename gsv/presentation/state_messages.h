// A simulation's state as ROS 2 messages.
//
// Frames  "world"; a robot or other moving body is the frame NAME, a link that moves against it
//         NAME/LINK, a sensor NAME/SENSOR.
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
#include "gsv/simulation/types.h"

namespace gsv::presentation {

inline constexpr std::string_view kWorldFrame = "world";

messages::gsv_msgs::Poses PosesMessage(const world::Snapshot& snapshot,
                                       const std::vector<PoseEntry>& list);

// world → body for each entry that is a body, body → link for each that is a link.
messages::tf2_msgs::TFMessage TransformsMessage(const world::Snapshot& snapshot,
                                                const std::vector<PoseEntry>& list);

// Appends the transform of one sensor, against its robot or the moving link it sits on.
void AppendSensorTransform(const world::Layout& layout, int body,
                           const model::SensorDescription& sensor, base::SimTime time,
                           messages::tf2_msgs::TFMessage& message);

messages::gsv_msgs::SimulationStatus StatusMessage(const simulation::SimulationStatus& status);
messages::gsv_msgs::LifecycleEvent EventMessage(const simulation::Event& event);

// One robot's beams as pairs of points in the world.
messages::visualization_msgs::Marker BeamsMarker(const std::string& robot, base::SimTime time,
                                                 std::vector<geometry::Vector3> points_in_world);
// Takes a robot's beams away.
messages::visualization_msgs::Marker NoBeamsMarker(const std::string& robot, base::SimTime time);

std::string FrameOf(std::string_view body, std::string_view part);

}  // namespace gsv::presentation
