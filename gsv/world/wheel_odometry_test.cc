#include "gsv/world/wheel_odometry.h"

#include <cmath>

#include <gtest/gtest.h>

#include "gsv/base/test_within.h"
#include "gsv/geometry/constants.h"

namespace gsv::world {
namespace {

using geometry::kPi;
constexpr double kRadius = 0.1, kSeparation = 0.4, kStep = 0.01;

// A robot with two wheels. The right wheel's axle points to the right, so its angle decreases when
// the robot drives forwards.
std::shared_ptr<const Layout> Robot(model::DriveKind kind) {
  auto model = std::make_shared<model::Model>();
  model->links.resize(3);
  for (int wheel = 0; wheel < 2; ++wheel) {
    model::Joint joint;
    joint.kind = model::JointKind::kContinuous;
    joint.parent = 0;
    joint.child = wheel + 1;
    joint.axis = {0, wheel == 0 ? 1.0 : -1.0, 0};
    model->joints.push_back(joint);
  }
  model->drive.emplace();
  model->drive->kind = kind;
  model->drive->left_wheels = {0};
  model->drive->right_wheels = {1};
  model->drive->wheel_radius = kRadius;
  model->drive->wheel_separation = kSeparation;
  Body body;
  body.name = "robot";
  body.model = model;
  body.kind = BodyKind::kPlanarBase;
  return MakeLayout(1, {body}, std::make_shared<model::WorldDescription>());
}

// Rolls the wheels `steps` times by these distances in metres.
Odometry AfterRolling(double left, double right, int steps) {
  const auto layout = Robot(model::DriveKind::kDifferential);
  WheelOdometry wheels;
  wheels.SetLayout(*layout);
  State state = InitialState(*layout);
  for (int i = 0; i < steps; ++i) {
    wheels.KeepWheels(state);
    state.joint_positions[0] += left / kRadius;
    state.joint_positions[1] -= right / kRadius;
    wheels.Advance(kStep, state);
  }
  return state.bodies[0].odometry;
}

TEST(WheelOdometry, MovesStraightByTheDistanceThatBothWheelsRoll) {
  const Odometry odometry = AfterRolling(0.02, 0.02, 50);
  EXPECT_NEAR(odometry.place.x, 1, 1e-12);
  EXPECT_EQ(odometry.place.y, 0);
  EXPECT_EQ(odometry.place.sine, 0);
  EXPECT_NEAR(odometry.linear, 2, 1e-9);
}

TEST(WheelOdometry, FollowsAnArcExactlyForAnyStep) {
  // The path is a quarter of a circle of radius 1 to the left.
  const double left = (1 - kSeparation / 2) * kPi / 2, right = (1 + kSeparation / 2) * kPi / 2;
  for (const int steps : {1, 7, 1000}) {
    const Odometry odometry = AfterRolling(left / steps, right / steps, steps);
    EXPECT_WITHIN(odometry.place.x, 1, 1e-9, "m") << steps;
    EXPECT_WITHIN(odometry.place.y, 1, 1e-9, "m") << steps;
    EXPECT_NEAR(odometry.place.cosine, 0, 1e-9) << steps;
    EXPECT_NEAR(odometry.place.sine, 1, 1e-9) << steps;
    EXPECT_NEAR(odometry.angular, kPi / 2 / steps / kStep, 1e-6) << steps;
  }
}

TEST(WheelOdometry, FollowsTheActualVelocityOfOtherDrives) {
  const auto layout = Robot(model::DriveKind::kMecanum);
  WheelOdometry wheels;
  wheels.SetLayout(*layout);
  State state = InitialState(*layout);
  state.bodies[0].odometry.place = {0, 0, 0, 1};
  // The base faces along y, so a motion to its left is in the direction of -x.
  state.bodies[0].drive.actual = {0, 1, 0};
  wheels.KeepWheels(state);
  wheels.Advance(0.5, state);
  EXPECT_NEAR(state.bodies[0].odometry.place.x, -0.5, 1e-12);
  EXPECT_NEAR(state.bodies[0].odometry.place.y, 0, 1e-12);
}

TEST(WheelOdometry, AdvancesOneBodyAsAllBodies) {
  for (const auto kind : {model::DriveKind::kDifferential, model::DriveKind::kMecanum}) {
    const auto layout = Robot(kind);
    WheelOdometry all, one;
    all.SetLayout(*layout);
    one.SetLayout(*layout);
    State expected = InitialState(*layout);
    expected.bodies[0].drive.actual = {0.3, 0.1, 0.5};
    State state = expected;
    one.KeepWheels(state);
    for (int i = 0; i < 5; ++i) {
      all.KeepWheels(expected);
      for (State* each : {&expected, &state}) {
        each->joint_positions[0] += 0.1 * i;
        each->joint_positions[1] -= 0.2;
      }
      all.Advance(kStep, expected);
      one.AdvanceBody(kStep, 0, 1, state);
    }
    EXPECT_EQ(state.bodies[0].odometry.place, expected.bodies[0].odometry.place);
    EXPECT_EQ(state.bodies[0].odometry.angular, expected.bodies[0].odometry.angular);
  }
}

TEST(WheelOdometry, AdvancesByEqualStepsAtOnce) {
  const auto layout = Robot(model::DriveKind::kMecanum);
  WheelOdometry wheels;
  wheels.SetLayout(*layout);
  State single = InitialState(*layout);
  single.bodies[0].drive.actual = {0.3, 0.1, 0};
  State at_once = single;
  for (int i = 0; i < 4; ++i) wheels.AdvanceBody(kStep, 0, 1, single);
  wheels.AdvanceBody(kStep, 0, 4, at_once);
  EXPECT_EQ(at_once.bodies[0].odometry.place, single.bodies[0].odometry.place);
}

TEST(WheelOdometry, KeepsTheHeadingAUnitVectorOverAMillionSteps) {
  const Odometry odometry = AfterRolling(-0.01, 0.01, 1'000'000);
  EXPECT_NEAR(std::hypot(odometry.place.cosine, odometry.place.sine), 1, 1e-15);
  EXPECT_NEAR(std::atan2(odometry.place.sine, odometry.place.cosine),
              std::remainder(0.02 / kSeparation * 1e6, 2 * kPi), 1e-6);
}

TEST(WheelOdometry, IsPartOfTheHash) {
  const auto layout = Robot(model::DriveKind::kDifferential);
  State state = InitialState(*layout);
  base::Hash before, after;
  AddToHash(*layout, state, before);
  state.bodies[0].odometry.place.x = 1e-9;
  AddToHash(*layout, state, after);
  EXPECT_NE(before.Hex(), after.Hex());
}

}  // namespace
}  // namespace gsv::world
