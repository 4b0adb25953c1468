// Compares planar robots with textbook values. docs/fidelity.md lists the tolerances.

#include <gtest/gtest.h>

#include "gsv/base/test_table.h"
#include "gsv/base/test_within.h"
#include "gsv/dynamics/testing/test_world.h"
#include "gsv/dynamics/world_engine.h"
#include "gsv/geometry/constants.h"

namespace gsv::dynamics {
namespace {

using geometry::PlanarPose;
using testing::TestWorld;

using geometry::kPi;
constexpr double kSide = 10, kSeparation = 0.3, kRadius = 0.1;

// A disc with two wheels. Their true radii are the nominal radius times `left_scale` and
// `right_scale`.
std::shared_ptr<model::Model> TwoWheeled(double left_scale, double right_scale) {
  auto robot = testing::DiscRobot(0.2);
  for (const double side : {1.0, -1.0}) {
    robot->links.push_back({});
    model::Joint joint;
    joint.kind = model::JointKind::kContinuous;
    joint.parent = 0;
    joint.child = static_cast<int>(robot->links.size()) - 1;
    joint.model_from_joint = PlanarPose(0, side * kSeparation / 2, kRadius, 0);
    joint.axis = {0, 1, 0};
    robot->joints.push_back(joint);
  }
  robot->drive->left_wheels = {0};
  robot->drive->right_wheels = {1};
  robot->drive->wheel_separation = kSeparation;
  robot->drive->wheel_radius = kRadius;
  robot->drive->left_wheel_scale = left_scale;
  robot->drive->right_wheel_scale = right_scale;
  return robot;
}

// Borenstein and Feng's UMBmark: the robot drives once around a square of 10 m and stops at each
// corner. It drives counter-clockwise for turn = 1, clockwise for -1.
TestWorld AroundTheSquare(std::shared_ptr<model::Model> robot, double turn) {
  TestWorld world(MakeWorldEngine());
  world.AddRobot("robot", std::move(robot), {});
  EXPECT_TRUE(world.Start());
  for (int side = 0; side < 4; ++side) {
    world.Command("robot", {0.5, 0, 0});
    world.Run(kSide / 0.5, 0.01);
    world.Command("robot", {0, 0, turn * kPi / 4});
    world.Run(2, 0.01);
  }
  return world;
}

TEST(PlanarFidelity, ASquarePathWithoutWheelErrorsEndsAtItsStart) {
  for (const double turn : {1.0, -1.0}) {
    TestWorld world = AroundTheSquare(TwoWheeled(1, 1), turn);
    EXPECT_WITHIN(world.position("robot").x, 0, 1e-9, "m");
    EXPECT_WITHIN(world.position("robot").y, 0, 1e-9, "m");
    EXPECT_NEAR(geometry::WrapAngle(world.yaw("robot")), 0, 1e-9);
  }
}

TEST(PlanarFidelity, UnequalWheelsMissTheStartByTheClosedForm) {
  // Source: J. Borenstein and L. Feng, "Measurement and correction of systematic odometry errors in
  // mobile robots", IEEE Trans. Robotics and Automation 12(6), 1996. E is the diameter of the right
  // wheel divided by the diameter of the left wheel. Then each side is an arc of radius R = b/2 (E
  // + 1) / (E - 1) that turns by beta = L / R. The end differs from the start by 2 L beta along
  // both axes.
  base::testing::Table table("umbmark");
  for (const double ratio : {1.00002, 1.00005, 1.0001, 1.00015, 1.0002}) {
    const double left = 2 / (1 + ratio), right = 2 * ratio / (1 + ratio);
    const double beta = kSide / (kSeparation / 2 * (ratio + 1) / (ratio - 1));
    const double expected = 2 * kSide * beta;
    for (const double turn : {1.0, -1.0}) {
      TestWorld world = AroundTheSquare(TwoWheeled(left, right), turn);
      EXPECT_WITHIN_PERCENT(world.position("robot").x, turn * expected, 2);
      EXPECT_WITHIN_PERCENT(world.position("robot").y, -expected, 2);
      EXPECT_WITHIN_PERCENT(geometry::WrapAngle(world.yaw("robot")), 4 * beta, 2);
      // According to the wheels, the path is a perfect square: odometry does not notice the error.
      table.Row({ratio, turn * world.position("robot").x, -world.position("robot").y, expected});
      const double left_path = world.joint("robot", 0) * kRadius;
      const double right_path = world.joint("robot", 1) * kRadius;
      EXPECT_WITHIN((left_path + right_path) / 2, 4 * kSide, 1e-9, "m");
      EXPECT_WITHIN((right_path - left_path) / kSeparation, turn * 2 * kPi, 1e-9, "rad");
    }
  }
}

TEST(PlanarFidelity, AnAccelerationLimitIsRespected) {
  auto robot = TwoWheeled(1, 1);
  robot->drive->linear_acceleration = {-2, 0.5};
  TestWorld world(MakeWorldEngine());
  world.AddRobot("robot", robot, {});
  ASSERT_TRUE(world.Start());
  world.Command("robot", {1, 0, 0});
  world.Run(3, 0.001);
  // The robot accelerates for two seconds (1 m), and then drives one second at 1 m/s. The sum over
  // the steps differs from the integral by at most the length of one step.
  EXPECT_WITHIN(world.position("robot").x, 2, 0.002, "m");
  world.Command("robot", {0, 0, 0});
  world.Run(1, 0.001);
  // The stopping distance is v² / 2 a.
  EXPECT_WITHIN(world.position("robot").x, 2 + 0.25, 0.002, "m");
  EXPECT_EQ(world.body("robot").drive.actual.linear, 0);
}

// A base with two axles rotates such that the torque of wheels that slide lengthwise balances the
// torque of wheels that slide sideways.
TEST(PlanarFidelity, SlippingSkidSteerTurnsLessThanItsWheels) {
  const double base = 0.5, along = 2, across = 5;
  auto robot = TwoWheeled(1, 1);
  for (int i = 0; i < 2; ++i) {
    for (const double x : {base / 2, -base / 2}) {
      model::Joint joint = robot->joints[static_cast<std::size_t>(i)];
      joint.model_from_joint.position.x = x;
      (i == 0 ? robot->drive->left_wheels : robot->drive->right_wheels)
          .push_back(static_cast<int>(robot->joints.size()));
      joint.child = static_cast<int>(robot->links.size());
      robot->links.emplace_back();
      robot->joints.push_back(joint);
    }
  }
  robot->drive->left_wheels.erase(robot->drive->left_wheels.begin());
  robot->drive->right_wheels.erase(robot->drive->right_wheels.begin());
  robot->drive->slip = {along, across};
  TestWorld world(MakeWorldEngine());
  world.AddRobot("robot", robot, {});
  ASSERT_TRUE(world.Start());
  world.Command("robot", {0, 0, 1});
  world.Run(2, 0.01);
  const double b2 = kSeparation * kSeparation;
  EXPECT_WITHIN(world.yaw("robot"), 2 * b2 / (b2 + base * base * along / across), 1e-9, "rad");
  // According to the wheels, the base has rotated by two radians.
  const double right_path = world.joint("robot", robot->drive->right_wheels[0]) * kRadius;
  EXPECT_WITHIN(right_path, 2 * kSeparation / 2, 1e-9, "m");
}

TEST(PlanarFidelity, SlippingRobotDriftsOutOfItsArc) {
  const double speed = 1.5, rate = 0.8, lateral = 2;
  auto robot = TwoWheeled(1, 1);
  robot->drive->slip = {0, lateral};
  TestWorld world(MakeWorldEngine());
  world.AddRobot("robot", robot, {});
  ASSERT_TRUE(world.Start());
  world.Command("robot", {speed, 0, rate});
  world.Run(2 * kPi / rate, 2 * kPi / rate / 1000);
  // The path is a circle whose radius follows from the total velocity. The circle closes after the
  // time that the wheels' turning rate gives.
  const double drift = lateral * speed * rate / 9.80665 * speed;
  EXPECT_WITHIN(Norm(world.body("robot").linear_velocity), std::hypot(speed, drift), 1e-9, "m/s");
  EXPECT_WITHIN(world.position("robot").x, 0, 1e-6, "m");
  EXPECT_WITHIN(world.joint("robot", 1) * kRadius,
                2 * kPi / rate * (speed + rate * kSeparation / 2), 1e-6, "m");
}

// The drift is computed as in SlippingRobotDriftsOutOfItsArc. But Gazebo's WheelSlip gives each
// wheel a constant load instead of its share of the weight. So the compliance is divided by
// `load_ratio`, the constant load divided by the share of the weight.
TEST(PlanarFidelity, WheelsOfGazebosWheelSlipDriftByTheirOwnCompliance) {
  const double speed = 1.5, rate = 0.8, lateral = 2, mass = 12, load_ratio = 1.25;
  auto robot = TwoWheeled(1, 1);
  for (model::Link& link : robot->links) link.inertial.mass = mass / 3;
  for (const std::size_t link : {1U, 2U}) {
    robot->links[link].wheel =
        model::SlippingWheel{{0, lateral}, load_ratio * mass * 9.80665 / 2, kRadius};
  }
  ASSERT_EQ(robot->links.size(), 3U);
  TestWorld world(MakeWorldEngine());
  world.AddRobot("robot", robot, {});
  ASSERT_TRUE(world.Start());
  world.Command("robot", {speed, 0, rate});
  world.Run(0.1, 0.01);
  const double drift = lateral / load_ratio * speed * rate / 9.80665 * speed;
  EXPECT_WITHIN(Norm(world.body("robot").linear_velocity), std::hypot(speed, drift), 1e-9, "m/s");
}

}  // namespace
}  // namespace gsv::dynamics
