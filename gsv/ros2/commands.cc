#include "gsv/ros2/commands.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "gsv/base/log.h"
#include "gsv/messages/cdr.h"
#include "gsv/messages/geometry_msgs.h"
#include "gsv/messages/time.h"

namespace gsv::ros2 {
namespace {

using messages::geometry_msgs::Twist;
using messages::geometry_msgs::TwistStamped;

constexpr const char* kCommandTopic = "cmd_vel";

bool IsFiniteTwist(const Twist& twist) {
  const double values[] = {twist.linear.x,  twist.linear.y,  twist.linear.z,
                           twist.angular.x, twist.angular.y, twist.angular.z};
  return std::all_of(std::begin(values), std::end(values),
                     [](double v) { return std::isfinite(v); });
}

base::Result<world::DriveCommand> CommandOf(const Twist& twist) {
  if (!IsFiniteTwist(twist)) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "the velocities must be finite, found NaN or infinity");
  }
  return world::DriveCommand{twist.linear.x, twist.linear.y, twist.angular.z};
}

}  // namespace

base::Result<std::vector<double>> DecodeFloat64MultiArray(std::span<const std::byte> sample) {
  messages::CdrReader reader(sample);
  // Each element of layout.dim takes at least 12 bytes: the length of its label and two numbers.
  const std::size_t dimensions = reader.ReadCount(12);
  for (std::size_t i = 0; i < dimensions; ++i) {
    std::string label;
    std::uint32_t size = 0, stride = 0;
    reader.Read(label);
    reader.Read(size);
    reader.Read(stride);
  }
  std::uint32_t offset = 0;
  reader.Read(offset);
  std::vector<double> values(reader.ReadCount(sizeof(double)));
  reader.ReadBlock(values.data(), values.size() * sizeof(double), sizeof(double));
  if (auto ok = reader.Finish(); !ok) return base::Fail(ok.error());
  return values;
}

CommandInput::CommandInput(const std::shared_ptr<simulation::Agent>& agent, world::Body body,
                           std::shared_ptr<NodeSteps> steps)
    : agent_(agent), body_(std::move(body)), steps_(std::move(steps)), robot_(agent->robot()) {}

void CommandInput::TakeTwist(std::span<const std::byte> sample) {
  const auto twist = messages::Decode<Twist>(sample);
  if (!twist) return Note(base::Fail(twist.error()), kCommandTopic);
  const auto command = CommandOf(*twist);
  if (!command) return Note(base::Fail(command.error()), kCommandTopic);
  Apply(*command);
}

void CommandInput::TakeTwistStamped(std::span<const std::byte> sample) {
  const auto stamped = messages::Decode<TwistStamped>(sample);
  if (!stamped) return Note(base::Fail(stamped.error()), kCommandTopic);
  const auto command = CommandOf(stamped->twist);
  if (!command) return Note(base::Fail(command.error()), kCommandTopic);
  if (steps_ == nullptr || !steps_->IsOpen(robot_)) return Apply(*command);
  ++taken_;
  steps_->Offer(robot_, messages::ToSimTime(stamped->header.stamp), *command);
}

void CommandInput::Apply(const world::DriveCommand& command) {
  const std::shared_ptr<simulation::Agent> agent = agent_.lock();
  if (agent == nullptr) return;
  Note(agent->Command(command), kCommandTopic);
}

void CommandInput::TakeJoints(std::span<const std::byte> sample, const std::vector<int>& joints,
                              world::JointCommand::Kind kind) {
  constexpr const char* kTopic = "joint commands";
  const auto values = DecodeFloat64MultiArray(sample);
  if (!values) return Note(base::Fail(values.error()), kTopic);
  if (values->size() != joints.size()) {
    return Note(base::Fail(base::ErrorCode::kInvalidArgument,
                           fmt::format("expected {} values, one for each joint, found {}",
                                       joints.size(), values->size())),
                kTopic);
  }
  CommandJoints(joints, kind, *values, kTopic);
}

void CommandInput::CommandPositions(const std::vector<int>& joints,
                                    const std::vector<double>& positions) {
  CommandJoints(joints, world::JointCommand::Kind::kPosition, positions, "joint_trajectory");
}

void CommandInput::CommandJoints(const std::vector<int>& joints, world::JointCommand::Kind kind,
                                 const std::vector<double>& values, const char* topic) {
  const std::shared_ptr<simulation::Agent> agent = agent_.lock();
  if (agent == nullptr) return;
  const auto is_finite = [](double value) { return std::isfinite(value); };
  if (!std::all_of(values.begin(), values.end(), is_finite)) {
    return Note(base::Fail(base::ErrorCode::kInvalidArgument,
                           "the values must be finite, found NaN or infinity"),
                topic);
  }
  // All commands are checked before the first one is applied.
  base::Status status;
  for (std::size_t i = 0; i < joints.size() && status; ++i) {
    status = world::CheckJointCommand(body_, joints[i], {kind, values[i]});
  }
  for (std::size_t i = 0; i < joints.size() && status; ++i) {
    status = agent->CommandJoint(joints[i], {kind, values[i]});
  }
  Note(status, topic);
}

void CommandInput::Refuse(const base::Error& error, const char* topic) {
  Note(base::Fail(error), topic);
}

void CommandInput::Note(const base::Status& status, const char* topic) {
  if (status) {
    ++taken_;
    return;
  }
  const base::ErrorCode code = status.error().code;
  // A command may arrive too late: after the end of the simulation, or, in lockstep, when its agent
  // already waits (see agent.h).
  if (code == base::ErrorCode::kNotRunning || code == base::ErrorCode::kEnded) return;
  if (refused_++ == 0) {
    spdlog::warn("{}: {} from ROS 2 is refused: {}. Further refusals are not logged", robot_, topic,
                 status.error().Sentence());
  }
}

}  // namespace gsv::ros2
