#include "gsv/dynamics/motion/drive_kinematics.h"

#include <cmath>

#include <gtest/gtest.h>

#include "gsv/base/random.h"

namespace gsv::dynamics {
namespace {

using base::FromSeconds;
using model::DriveKind;

// Wheels are at (±0.3, ±0.25), the rear ones first. The front wheels have steering joints.
model::Model FourWheels(DriveKind kind) {
  model::Model model;
  model.name = "cart";
  model.links.resize(7);
  model.drive = model::Drive{};
  model::Drive& drive = *model.drive;
  drive.kind = kind;
  drive.wheel_radius = 0.1;
  drive.wheel_separation = 0.5;
  drive.wheel_base = 0.6;
  for (const double x : {-0.3, 0.3}) {
    for (const double y : {0.25, -0.25}) {
      model::Joint wheel;
      wheel.kind = model::JointKind::kContinuous;
      wheel.model_from_joint.position = {x, y, 0.1};
      wheel.axis = {0, 1, 0};
      (y > 0 ? drive.left_wheels : drive.right_wheels)
          .push_back(static_cast<int>(model.joints.size()));
      model.joints.push_back(wheel);
    }
  }
  for (const double y : {0.25, -0.25}) {
    model::Joint steering;
    steering.kind = model::JointKind::kRevolute;
    steering.model_from_joint.position = {0.3, y, 0.1};
    drive.steered.push_back(static_cast<int>(model.joints.size()));
    model.joints.push_back(steering);
  }
  return model;
}

DriveKinematics Make(const model::Model& model) {
  auto kinematics = DriveKinematics::Create(model);
  EXPECT_TRUE(kinematics);
  return *kinematics;
}

world::DriveState Commanded(const world::DriveCommand& command) {
  world::DriveState state;
  state.command = command;
  return state;
}

TEST(DriveKinematics, AcceleratesAndBrakesWithinItsLimits) {
  model::Model model = FourWheels(DriveKind::kDifferential);
  model.drive->linear_velocity = {-0.5, 1};
  model.drive->linear_acceleration = {-4, 2};
  model.drive->angular_acceleration = {-3, 3};
  const DriveKinematics drive = Make(model);
  world::DriveState state = Commanded({5, 7, 1});
  for (int i = 1; i <= 100; ++i) {
    state.actual = drive.Next(state, {}, 0.01);
    EXPECT_NEAR(state.actual.linear, std::min(1.0, 0.02 * i), 1e-12);
    EXPECT_NEAR(state.actual.angular, std::min(1.0, 0.03 * i), 1e-12);
    EXPECT_EQ(state.actual.lateral, 0);
  }
  state.command = {-5, 0, 0};
  state.actual = drive.Next(state, {}, 0.01);
  EXPECT_NEAR(state.actual.linear, 0.96, 1e-12);
  for (int i = 0; i < 100; ++i) state.actual = drive.Next(state, {}, 0.01);
  EXPECT_NEAR(state.actual.linear, -0.5, 1e-12);
}

// Drives with random commands. At random instants, an obstacle stops the base or makes it slide.
TEST(DriveKinematics, MaxSpeedsAreNotExceededWithinSomeSteps) {
  base::Noise noise(1, 2, 3);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * noise.Uniform();
  };
  for (const DriveKind kind : {DriveKind::kDifferential, DriveKind::kMecanum, DriveKind::kAckermann,
                               DriveKind::kSynchro, DriveKind::kVelocity}) {
    model::Model model = FourWheels(kind);
    model.drive->linear_velocity = {-0.5, 1};
    model.drive->linear_acceleration = {-4, 2};
    model.drive->angular_acceleration = {-5, 3};
    model.drive->command_timeout = FromSeconds(0.05);
    if (kind == DriveKind::kDifferential) {
      model.drive->left_wheel_scale = 1.1;
      model.drive->slip = {0.05, 0.1};
    }
    const DriveKinematics kinematics = Make(model);
    double nearest = 0;
    for (int round = 0; round < 2000; ++round) {
      world::DriveState state = Commanded({uniform(-2, 2), uniform(-1, 1), uniform(-2, 2)});
      state.actual = {uniform(-0.5, 1), uniform(-0.5, 1), uniform(-1, 1)};
      if (!kinematics.can_move_sideways()) state.actual.lateral = 0;
      const int steps = 2 + round % 7;
      const DriveKinematics::Speeds most = kinematics.MaxSpeeds(state, steps);
      for (int i = 0; i < steps; ++i) {
        state.actual = kinematics.Next(state, FromSeconds(0.01 * i), 0.01);
        const geometry::Twist twist = kinematics.OriginTwist(state.actual);
        ASSERT_LE(std::hypot(twist.x, twist.y), most.linear) << round;
        ASSERT_LE(std::abs(twist.angular), most.angular) << round;
        nearest = std::max(nearest, std::hypot(twist.x, twist.y) / most.linear);
        if (uniform(0, 1) < 0.7) continue;
        if (!kinematics.can_move_sideways()) {
          state.actual.linear = 0;
          continue;
        }
        const double angle = uniform(0, 6), x = std::cos(angle), y = std::sin(angle);
        const double into = x * state.actual.linear + y * state.actual.lateral;
        state.actual.linear -= into * x;
        state.actual.lateral -= into * y;
      }
    }
    EXPECT_GT(nearest, 0.8);
  }
}

TEST(DriveKinematics, BrakesAfterTheCommandTimeout) {
  model::Model model = FourWheels(DriveKind::kDifferential);
  model.drive->command_timeout = FromSeconds(0.5);
  const DriveKinematics drive = Make(model);
  world::DriveState state = Commanded({1, 0, 1});
  state.command_time = FromSeconds(2);
  EXPECT_EQ(drive.Next(state, FromSeconds(2.49), 0.01).linear, 1);
  EXPECT_EQ(drive.Next(state, FromSeconds(2.5), 0.01), (world::DriveCommand{}));
}

TEST(DriveKinematics, NonFiniteCommandsAreZeroAndLargeCommandsAreLimited) {
  const DriveKinematics drive = Make(FourWheels(DriveKind::kDifferential));
  const double nan = std::nan("");
  EXPECT_EQ(drive.Next(Commanded({nan, nan, INFINITY}), {}, 0.01), (world::DriveCommand{}));
  EXPECT_EQ(drive.Next(Commanded({1e300, 0, -1e300}), {}, 0.01),
            (world::DriveCommand{kMaxLinearSpeed, 0, -kMaxAngularSpeed}));
}

TEST(DriveKinematics, AckermannTurnsNoTighterThanItsSteering) {
  model::Model model = FourWheels(DriveKind::kAckermann);
  model.drive->steering_limit = 0.5;
  const DriveKinematics drive = Make(model);
  EXPECT_EQ(drive.Next(Commanded({0, 0, 1}), {}, 0.01).angular, 0);
  EXPECT_NEAR(drive.Next(Commanded({2, 0, 9}), {}, 0.01).angular, 2 * std::tan(0.5) / 0.6, 1e-12);
  EXPECT_NEAR(drive.Next(Commanded({-2, 0, 9}), {}, 0.01).angular, 2 * std::tan(0.5) / 0.6, 1e-12);
  EXPECT_NEAR(drive.Next(Commanded({2, 0, 1}), {}, 0.01).angular, 1, 1e-12);
  EXPECT_FALSE(drive.can_turn_on_the_spot());
  // The rear axle, 0.3 m behind the origin, does not slip sideways.
  const geometry::Twist twist = drive.OriginTwist({2, 0, 1});
  EXPECT_NEAR(twist.y - twist.angular * 0.3, 0, 1e-12);
  EXPECT_EQ(twist.x, 2);
}

TEST(DriveKinematics, AckermannWheelsAreTangentToTheirCircles) {
  const model::Model model = FourWheels(DriveKind::kAckermann);
  const DriveKinematics drive = Make(model);
  std::vector<double> positions(6), velocities(6);
  const world::DriveCommand motion{2, 0, 1};  // The centre of the circle is 2 m to the left of the
                                              // rear axle.
  drive.TurnJoints({0.02, 0, 0.01}, motion, 0.01, positions, velocities);
  EXPECT_NEAR(positions[4], std::atan(0.6 / 1.75), 1e-12);
  EXPECT_NEAR(positions[5], std::atan(0.6 / 2.25), 1e-12);
  EXPECT_NEAR(velocities[4], positions[4] / 0.01, 1e-9);
  // The speed of each wheel is its distance from the centre of the circle times the angular
  // velocity.
  EXPECT_NEAR(velocities[0], 1.75 / 0.1, 1e-12);
  EXPECT_NEAR(velocities[1], 2.25 / 0.1, 1e-12);
  EXPECT_NEAR(velocities[2], std::hypot(1.75, 0.6) / 0.1, 1e-12);
  EXPECT_NEAR(velocities[3], std::hypot(2.25, 0.6) / 0.1, 1e-12);
  EXPECT_NEAR(positions[3], std::hypot(2.25, 0.6) / 0.1 * 0.01, 1e-12);
  // At rest, the steering angle does not change.
  const double steered = positions[4];
  drive.TurnJoints({}, {}, 0.01, positions, velocities);
  EXPECT_EQ(positions[4], steered);
  EXPECT_EQ(velocities[4], 0);
}

TEST(DriveKinematics, MecanumWheelsMoveTheBaseSideways) {
  const DriveKinematics drive = Make(FourWheels(DriveKind::kMecanum));
  std::vector<double> positions(6), velocities(6);
  drive.TurnJoints({0, 1, 0}, {0, 1, 0}, 1, positions, velocities);
  // When the base moves to the left, the front left and rear right wheels rotate backwards.
  EXPECT_NEAR(positions[2], -10, 1e-12);
  EXPECT_NEAR(positions[3], 10, 1e-12);
  EXPECT_NEAR(positions[0], 10, 1e-12);
  EXPECT_NEAR(positions[1], -10, 1e-12);
  drive.TurnJoints({0, 0, 1}, {0, 0, 1}, 1, positions, velocities);
  EXPECT_NEAR(velocities[2], -(0.5 + 0.6) / 2 / 0.1, 1e-12);
  EXPECT_NEAR(velocities[1], (0.5 + 0.6) / 2 / 0.1, 1e-12);
  EXPECT_EQ(drive.Next(Commanded({0, 1, 0}), {}, 0.01).lateral, 1);
}

TEST(DriveKinematics, SynchroWheelsRollEqually) {
  const DriveKinematics drive = Make(FourWheels(DriveKind::kSynchro));
  std::vector<double> positions(6), velocities(6);
  drive.TurnJoints({1, 0, 2}, {1, 0, 2}, 1, positions, velocities);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(positions[i], 10, 1e-12);
}

TEST(DriveKinematics, RejectsInvalidDrives) {
  const auto message = [](auto change) {
    model::Model model = FourWheels(DriveKind::kAckermann);
    change(*model.drive);
    const auto kinematics = DriveKinematics::Create(model);
    return kinematics ? std::string() : kinematics.error().Sentence();
  };
  EXPECT_EQ(message([](model::Drive& d) { d.wheel_radius = 0; }),
            "cart: the drive's wheel radius is 0; it must be above 0");
  EXPECT_EQ(message([](model::Drive& d) { d.wheel_base = NAN; }),
            "cart: the drive's wheel base is nan; it must be above 0");
  EXPECT_EQ(message([](model::Drive& d) { d.left_wheels = {9}; }),
            "cart: the drive names joint 9, but the model has 6 joints");
  EXPECT_EQ(message([](model::Drive& d) {
              d.linear_acceleration = {1, 2};
            }),
            "cart: the drive's linear acceleration from 1 to 2 must include 0");
  EXPECT_EQ(message([](model::Drive& d) { d.steering_limit = 2; }),
            "cart: the drive's steering limit is 2 rad; it must lie between 0 and 1.57 rad");
}

}  // namespace
}  // namespace gsv::dynamics
