// Makes the messages about robots' sensors: topics of readings, transforms, and the lines that
// viewers draw.
//
// Frames  see gsv/sensing/frames.h.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "gsv/messages/tf2_msgs.h"
#include "gsv/messages/visualization_msgs.h"
#include "gsv/sensing/registry.h"
#include "gsv/simulation/simulation.h"

namespace gsv::presentation {

// Returns the topic of a sensor's readings, such as "/pebble/camera", or of a companion message,
// such as "/pebble/camera/camera_info".
std::string SensorTopic(const std::string& robot, const std::string& sensor);
std::string CompanionTopic(const std::string& sensor_topic, const sensing::Companion& companion);
// Returns the topics of all sensors of the robot.
std::vector<std::string> SensorTopicNames(const simulation::Simulation& simulation,
                                          const std::string& robot);

// Appends the transform of one sensor relative to its robot or its moving link. For a camera, also
// appends the transform of its optical frame.
void AppendSensorTransform(const world::Layout& layout, int body,
                           const model::SensorDescription& sensor, const sensing::SensorType& type,
                           base::SimTime time, messages::tf2_msgs::TFMessage& message);

// Whether viewers draw lines for the sensor's readings. Viewers always draw the beams of a sensor.
// They draw a sensor's points only if the model file sets <visualize> for the sensor.
bool HasLines(const sensing::SensorType& type, const model::SensorDescription& sensor);

// Collects the lines of all robots at one instant. The message has a marker for each robot. After a
// robot has no more lines, kDeletions messages contain a deletion for it, because a viewer with a
// slow connection gets only some of the messages.
class BeamMarkers {
 public:
  static constexpr int kDeletions = 45;  // number of messages that contain a deletion

  // Adds the lines of a reading: its beams, or short dashes at its points. `body` is the robot's
  // index in the snapshot's layout.
  void Add(const world::Snapshot& snapshot, int body, const sensing::SensorType& type,
           const sensing::Sensor& sensor, const sensing::Reading& reading);
  // Returns the lines that were added since the last call, and clears them.
  messages::visualization_msgs::MarkerArray Take(base::SimTime time);

 private:
  // The lines of one robot.
  struct Lines {
    bool is_present = false;  // whether Add() was called for the robot since the last Take()
    std::vector<messages::geometry_msgs::Point> points{};  // pairs of points, in the world frame
    // The number of messages that will contain the deletion of the lines, if there are no more.
    int deletions_left = 0;
  };
  std::map<std::string, Lines> lines_;  // by robot
  // The body and the link of the last Add(), the pose of this link, and the lines of the body. Add()
  // reuses them, because most robots have all their sensors on one link.
  int body_ = -1;
  int link_ = -1;
  geometry::Pose world_from_link_;
  Lines* lines_of_body_ = nullptr;
};

}  // namespace gsv::presentation
