// What is told of robots' sensors: the topics of their readings, where they sit, and the lines that
// are drawn of their readings.
//
// Frames  see gsv/sensing/frames.h.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "gsv/messages/tf2_msgs.h"
#include "gsv/messages/visualization_msgs.h"
#include "gsv/sensing/registry.h"
#include "gsv/simulation/simulation.h"

namespace gsv::presentation {

// "/pebble/camera", and of what goes with its readings "/pebble/camera/camera_info".
std::string SensorTopic(const std::string& robot, const std::string& sensor);
std::string CompanionTopic(const std::string& sensor_topic, const sensing::Companion& companion);
// Those of all the robot's sensors.
std::vector<std::string> SensorTopicNames(const simulation::Simulation& simulation,
                                          const std::string& robot);

// Appends the transform of one sensor, against its robot or the moving link it sits on; of a camera
// that of its optical frame as well.
void AppendSensorTransform(const world::Layout& layout, int body,
                           const model::SensorDescription& sensor, const sensing::SensorType& type,
                           base::SimTime time, messages::tf2_msgs::TFMessage& message);

// Whether readings are drawn as lines: of a type that is drawn as lines, and of one that is drawn
// as points where its file asks for it (<visualize>).
bool HasLines(const sensing::SensorType& type, const model::SensorDescription& sensor);

// The lines of all robots at one instant: a marker for each robot, and one that takes a robot's
// lines away that has none any more.
class BeamMarkers {
 public:
  // Adds the lines of a reading: its beams, or short dashes where they end of a type that is drawn
  // as points. `body` is the robot's index in the snapshot's layout.
  void Add(const world::Snapshot& snapshot, int body, const sensing::SensorType& type,
           const sensing::Sensor& sensor, const sensing::Reading& reading);
  // All that was added since the last time.
  messages::visualization_msgs::MarkerArray Take(base::SimTime time);

 private:
  std::map<std::string, std::vector<geometry::Vector3>> points_;  // in the world, by robot
  std::set<std::string> shown_;                                   // robots in the last message
};

}  // namespace gsv::presentation
