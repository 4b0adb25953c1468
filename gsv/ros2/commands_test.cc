#include "gsv/ros2/commands.h"

#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "gsv/messages/cdr.h"
#include "gsv/messages/geometry_msgs.h"
#include "gsv/simulation/testing/test_simulation.h"

namespace gsv::ros2 {
namespace {

using messages::geometry_msgs::Twist;

messages::Bytes TwistBytes(double linear, double angular = 0) {
  Twist twist;
  twist.linear.x = linear;
  twist.angular.z = angular;
  messages::Bytes bytes;
  messages::Encode(twist, bytes);
  return bytes;
}

// Returns the body of the robot "robot".
world::Body BodyOf(const simulation::Simulation& simulation) {
  const auto layout = simulation.snapshot()->layout;
  return layout->bodies[static_cast<std::size_t>(layout->Find("robot"))];
}

struct CommandedRobot {
  CommandedRobot() {
    simulation = simulation::Make(simulation::Lockstep(std::chrono::seconds(1)));
    EXPECT_TRUE(simulation->AddRobot(simulation::Robot("robot", 0, 0)));
    input = std::make_unique<CommandInput>(simulation->agent("robot"), BodyOf(*simulation));
  }
  double XAtTheEnd() {
    EXPECT_EQ(simulation::RunToEnd(*simulation), simulation::Phase::kFinished);
    return simulation::PoseOf(*simulation, "robot").position.x;
  }
  std::shared_ptr<simulation::Simulation> simulation;
  std::unique_ptr<CommandInput> input;
};

TEST(CommandInput, DrivesARobotThatHasNoBehaviour) {
  CommandedRobot robot;
  robot.input->TakeTwist(TwistBytes(0.5));
  EXPECT_EQ(robot.input->taken(), 1u);
  // 0.5 m/s for 1 s; the command starts with the second step.
  EXPECT_NEAR(robot.XAtTheEnd(), 0.5, 0.02);
}

TEST(CommandInput, RejectsNonFiniteCommands) {
  CommandedRobot robot;
  Twist twist;
  // The drive ignores this component. Nevertheless, a value that is not finite is rejected.
  twist.linear.z = std::numeric_limits<double>::infinity();
  messages::Bytes sideways;
  messages::Encode(twist, sideways);
  robot.input->TakeTwist(TwistBytes(std::numeric_limits<double>::quiet_NaN()));
  robot.input->TakeTwist(TwistBytes(0, -std::numeric_limits<double>::infinity()));
  robot.input->TakeTwist(sideways);
  EXPECT_EQ(robot.input->refused(), 3u);
  EXPECT_EQ(robot.XAtTheEnd(), 0);
}

TEST(CommandInput, RejectsTruncatedCommands) {
  CommandedRobot robot;
  const messages::Bytes whole = TwistBytes(0.5);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    robot.input->TakeTwist(std::span(whole).first(size));
  }
  EXPECT_EQ(robot.input->refused(), whole.size());
  EXPECT_EQ(robot.XAtTheEnd(), 0);
}

TEST(CommandInput, KeepsOnlyTheLatestOfManyCommands) {
  CommandedRobot robot;
  for (int i = 0; i < 10'000; ++i) robot.input->TakeTwist(TwistBytes(-1));
  robot.input->TakeTwist(TwistBytes(0.5));
  EXPECT_EQ(robot.input->taken(), 10'001u);
  EXPECT_NEAR(robot.XAtTheEnd(), 0.5, 0.02);
}

// A robot with two prismatic joints at 0 m. Planar kinematics moves each joint at up to 1 m/s.
simulation::RobotSpecification TwoSliders() {
  auto model = std::make_shared<model::Model>();
  model->links.resize(3);
  model->links[0].name = "base";
  model->links[0].collisions.push_back({"base", {}, geometry::Box{{0.5, 0.5, 0.3}}, {}});
  for (const int child : {1, 2}) {
    model::Joint joint;
    joint.name = child == 1 ? "first" : "second";
    joint.kind = model::JointKind::kPrismatic;
    joint.parent = 0;
    joint.child = child;
    joint.position_limits = {0, 1};
    joint.velocity_limit = 1;
    model->joints.push_back(joint);
    model->links[static_cast<std::size_t>(child)].name = joint.name;
  }
  model->drive.emplace();
  model->drive->kind = model::DriveKind::kVelocity;
  model->movement = model::Movement::kPlanar;
  simulation::RobotSpecification robot = simulation::Robot("robot", 0, 0);
  robot.model = model;
  return robot;
}

messages::Bytes ArrayBytes(const std::vector<double>& values) {
  messages::Bytes bytes;
  {
    messages::CdrWriter writer(bytes);
    writer.WriteCount(0);
    writer.Write(std::uint32_t{0});
    writer.WriteCount(values.size());
    for (const double value : values) writer.Write(value);
  }
  return bytes;
}

// Sends the elements of `arrays`, which are positions for `joints`, one after the other. Returns the
// positions of the two joints after 1 s.
std::vector<double> PositionsAfter(const std::vector<std::vector<double>>& arrays,
                                   const std::vector<int>& joints = {0, 1}) {
  const auto simulation = simulation::Make(simulation::Lockstep(std::chrono::seconds(1)));
  EXPECT_TRUE(simulation->AddRobot(TwoSliders()));
  CommandInput input(simulation->agent("robot"), BodyOf(*simulation));
  for (const std::vector<double>& each : arrays) {
    input.TakeJoints(ArrayBytes(each), joints, world::JointCommand::Kind::kPosition);
  }
  EXPECT_EQ(input.taken() + input.refused(), arrays.size());
  EXPECT_EQ(simulation::RunToEnd(*simulation), simulation::Phase::kFinished);
  const auto snapshot = simulation->snapshot();
  return {simulation::JointReadingIn(*snapshot, snapshot->layout->Find("robot"), 0).position,
          simulation::JointReadingIn(*snapshot, snapshot->layout->Find("robot"), 1).position};
}

TEST(CommandInput, CommandsEachJointByAnArray) {
  const auto positions = PositionsAfter({{0.25, 0.5}});
  EXPECT_NEAR(positions[0], 0.25, 1e-9);
  EXPECT_NEAR(positions[1], 0.5, 1e-9);
}

TEST(CommandInput, IgnoresAnArrayWithANonFiniteNumber) {
  const double nan = std::numeric_limits<double>::quiet_NaN(),
               infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(PositionsAfter({{0.25, nan}, {0.25, -infinity}, {nan, 0.5}, {0.25}, {0.1, 0.2, 0.3}}),
            (std::vector<double>{0, 0}));
}

TEST(CommandInput, IgnoresAnArrayIfALaterJointRefusesItsCommand) {
  // The robot has no joint number 2.
  EXPECT_EQ(PositionsAfter({{0.25, 0.5, 0.5}}, {0, 1, 2}), (std::vector<double>{0, 0}));
}

TEST(CommandInput, TakesNoCommandsForARemovedRobot) {
  CommandedRobot robot;
  robot.simulation.reset();
  robot.input->TakeTwist(TwistBytes(0.5));
  EXPECT_EQ(robot.input->taken(), 0u);
}

TEST(Float64MultiArray, IsReadWithItsLayout) {
  messages::Bytes bytes;
  {
    messages::CdrWriter writer(bytes);
    writer.WriteCount(1);
    writer.Write(std::string_view("joints"));
    writer.Write(std::uint32_t{2});
    writer.Write(std::uint32_t{2});
    writer.Write(std::uint32_t{0});
    writer.WriteCount(2);
    writer.Write(1.5);
    writer.Write(-2.0);
  }
  const auto values = DecodeFloat64MultiArray(bytes);
  ASSERT_TRUE(values);
  EXPECT_EQ(*values, (std::vector<double>{1.5, -2.0}));
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_FALSE(DecodeFloat64MultiArray(std::span(bytes).first(size))) << size;
  }
}

TEST(Float64MultiArray, RejectsALayoutBeyondItsData) {
  messages::Bytes bytes;
  messages::CdrWriter(bytes).WriteCount(0xffffffff);
  EXPECT_FALSE(DecodeFloat64MultiArray(bytes));
}

}  // namespace
}  // namespace gsv::ros2
