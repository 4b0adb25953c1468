// One robot or station in ROS 2: a node with the topics of its sensors and of its commands.
//
// Threads  one.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "gsv/messages/tf2_msgs.h"
#include "gsv/ros2/commands.h"
#include "gsv/ros2/frames.h"
#include "gsv/ros2/node.h"
#include "gsv/ros2/options.h"
#include "gsv/ros2/robot_descriptions.h"
#include "gsv/ros2/source.h"
#include "gsv/sensing/sensor_set.h"
#include "gsv/simulation/simulation.h"

namespace gsv::ros2 {

// The ROS 2 node of one robot or station.
class RobotTopics {
 public:
  // The objects of the bridge that the topics of all robots use.
  struct Context {
    dds::Participant& participant;
    const Options& options;
    simulation::Simulation& simulation;
    sensing::SensorSet& sensors;  // creates the sensors that are sampled for ROS 2
    // called when a reader of one of the topics is added or removed
    std::function<void()> on_match;
  };

  // `name_space` is a name such as "/pebble", or "/". `takes_commands` is true if no behaviour
  // drives the robot.
  RobotTopics(const Context& context, const world::Body& body, std::string name_space,
              bool takes_commands);

  // Whether these topics still fit the body. False if its model, its kind or its sensors have
  // changed, or if the body now takes commands or no longer takes them.
  bool Fits(const world::Body& body, const std::vector<model::SensorDescription>& sensors,
            bool takes_commands) const;

  const std::string& body() const { return body_; }
  const NodeInfo& node() const { return node_.info(); }
  const std::vector<std::unique_ptr<Source>>& sources() const { return sources_; }

  void AppendMovingFrames(const world::Snapshot& snapshot,
                          messages::tf2_msgs::TFMessage& message) const;
  void AppendStaticFrames(const world::Snapshot& snapshot,
                          messages::tf2_msgs::TFMessage& message) const;

  // Sends robot_description as soon as it has a reader.
  void SendDescription(RobotDescriptions& descriptions);

  // Logs once if several nodes command this robot at the same time. Also logs once if a node sends
  // commands of another type. `endpoints` are the endpoints of other participants.
  void CheckPublishers(const std::vector<dds::Endpoint>& endpoints);

 private:
  void AddSensors(const Context& context);
  // Adds the topic of the true pose. Also adds joint states and odometry if the model has no
  // sensors for them.
  void AddImplied(const Context& context);
  // Adds the topics of a sensor. `is_only`: see RosSensor.
  void AddSensor(const Context& context, model::SensorDescription description, bool is_only);
  // Subscribes to the commands of drive and joints.
  void TakeCommands(const Context& context, const world::Body& body);
  void TakeJointCommands(const Context& context, const std::shared_ptr<CommandInput>& input);

  const std::string body_;  // name of the body in the world
  const std::shared_ptr<const model::Model> model_;
  const world::BodyKind kind_;
  const bool has_odometry_;  // whether the robot has wheel odometry
  const bool takes_commands_;
  const std::vector<model::SensorDescription> sensors_;
  const Frames frames_;
  std::vector<bool> is_optical_;  // whether each of sensors_ has an optical frame
  // Declared before node_, so that the sources are destroyed after node_. The readers of node_ call
  // the sources.
  std::vector<std::unique_ptr<Source>> sources_;
  Node node_;
  // Null after robot_description was sent, or if the participant refused the topic.
  dds::Writer* description_ = nullptr;
  // Type of cmd_vel, such as "geometry_msgs/msg/Twist"; empty if there is no such topic.
  std::string drive_type_;
  dds::Reader* drive_reader_ = nullptr;  // reader of cmd_vel; null if there is none
  // Whether CheckPublishers() has logged that several nodes command the robot, or a wrong type.
  bool has_warned_of_many_ = false;
  bool has_warned_of_type_ = false;
};

}  // namespace gsv::ros2
