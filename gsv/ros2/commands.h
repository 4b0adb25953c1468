// Applies the commands that ROS 2 nodes send to a robot's drive and joints.
//
// The bytes are untrusted input. A message that cannot be decoded, contains a number that is not
// finite, or has a command that a joint does not accept, is rejected as a whole: none of its values
// is applied. Only the robot's first rejected message is logged.
//
// Threads  Take…() on any threads; a command applies from the next step on.
#pragma once

#include <atomic>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "gsv/ros2/node_steps.h"
#include "gsv/simulation/agent.h"
#include "gsv/world/layout.h"

namespace gsv::ros2 {

// The commands from ROS 2 for one robot.
class CommandInput {
 public:
  // `body` is the robot's body. Its model and its kind determine which commands the joints accept.
  // `steps` is null if no ROS 2 node steps robots. While a node steps this robot, commands with a
  // time stamp are passed to `steps`.
  CommandInput(const std::shared_ptr<simulation::Agent>& agent, world::Body body,
               std::shared_ptr<NodeSteps> steps = nullptr);

  // geometry_msgs/msg/Twist: linear x and y in m/s, angular z in rad/s; the other numbers have no
  // effect, but must be finite.
  void TakeTwist(std::span<const std::byte> sample);
  void TakeTwistStamped(std::span<const std::byte> sample);
  // std_msgs/msg/Float64MultiArray: one value for each joint of `joints`, in the order of `joints`.
  void TakeJoints(std::span<const std::byte> sample, const std::vector<int>& joints,
                  world::JointCommand::Kind kind);

  // Commands these joints to these positions, in rad or m.
  void CommandPositions(const std::vector<int>& joints, const std::vector<double>& positions);
  // Counts a rejected message of `topic`. Logs only the first rejected message of the robot.
  void Refuse(const base::Error& error, const char* topic);

  // Numbers of applied and of rejected messages.
  std::uint64_t taken() const { return taken_; }
  std::uint64_t refused() const { return refused_; }

 private:
  // Commands the drive.
  void Apply(const world::DriveCommand& command);
  void CommandJoints(const std::vector<int>& joints, world::JointCommand::Kind kind,
                     const std::vector<double>& values, const char* topic);
  // Counts a message as applied or, if `status` is an error, as rejected.
  void Note(const base::Status& status, const char* topic);

  const std::weak_ptr<simulation::Agent> agent_;
  const world::Body body_;
  const std::shared_ptr<NodeSteps> steps_;  // null if no ROS 2 node steps robots
  const std::string robot_;
  std::atomic<std::uint64_t> taken_{0};    // number of applied messages
  std::atomic<std::uint64_t> refused_{0};  // number of rejected messages
};

// Returns the `data` of a std_msgs/msg/Float64MultiArray. Fails with kCorrupt.
base::Result<std::vector<double>> DecodeFloat64MultiArray(std::span<const std::byte> sample);

}  // namespace gsv::ros2
