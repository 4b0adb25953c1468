// Compares the readings of motion sensors with values that follow from the motion. docs/fidelity.md
// lists the expected values.

#include "gsv/base/test_within.h"
#include "gsv/geometry/constants.h"
#include "gsv/simulation/testing/test_simulation.h"

namespace gsv::simulation {
namespace {

using geometry::kPi;
constexpr double kRadius = 0.1, kSeparation = 0.3;

// A disc on two wheels. It has one sensor, 0.15 m ahead, whose name is its type. The true radii of
// the wheels are `left` and `right` times the radii that the drive assumes.
std::shared_ptr<model::Model> Rover(const std::string& sensor, double left = 1, double right = 1) {
  auto model = std::make_shared<model::Model>(*Disc(0.2));
  for (const double side : {1.0, -1.0}) {
    model->links.push_back({});
    model::Joint joint;
    joint.name = side > 0 ? "left" : "right";
    joint.kind = model::JointKind::kContinuous;
    joint.parent = 0;
    joint.child = static_cast<int>(model->links.size()) - 1;
    joint.model_from_joint = PlanarPose(0, side * kSeparation / 2, kRadius, 0);
    joint.axis = {0, 1, 0};
    model->joints.push_back(joint);
  }
  model->drive->kind = model::DriveKind::kDifferential;
  model->drive->left_wheels = {0};
  model->drive->right_wheels = {1};
  model->drive->wheel_separation = kSeparation;
  model->drive->wheel_radius = kRadius;
  model->drive->left_wheel_scale = left;
  model->drive->right_wheel_scale = right;
  model->sensors.clear();
  model::SensorDescription description;
  description.name = description.type = sensor;
  description.link_from_sensor = PlanarPose(0.15, 0, 0.1, 0);
  model->sensors.push_back(description);
  return model;
}

struct Leg {
  world::DriveCommand command;
  SimTime duration;
};

// The sensor's reading and the robot's pose after Drive().
struct Driven {
  std::vector<double> values;
  std::shared_ptr<const std::vector<std::string>> labels;
  geometry::Pose pose;
};

Driven Drive(std::shared_ptr<model::Model> model, const std::vector<Leg>& legs, double x = 0) {
  auto behaviour = std::make_shared<ThreadBehaviour>([&](Agent& agent, ClockId clock) {
    for (const Leg& leg : legs) {
      if (!agent.Command(leg.command) || !SleepFor(agent, clock, leg.duration)) return;
    }
  });
  SimTime duration{0};
  for (const Leg& leg : legs) duration += leg.duration;
  auto simulation = Make(Lockstep(duration));
  const std::string sensor = model->sensors[0].name;
  RobotSpecification robot = Robot("robot", x, 0, behaviour);
  robot.model = std::move(model);
  EXPECT_TRUE(simulation->AddRobot(std::move(robot)));
  EXPECT_EQ(RunToEnd(*simulation), Phase::kFinished);
  const auto reading = simulation->Watch("robot", sensor);
  EXPECT_TRUE(reading) << reading.error().Sentence();
  return {{reading->values.begin(), reading->values.end()},
          reading->labels,
          StatusOf(*simulation, "robot").world_from_robot};
}

std::vector<Leg> AroundTheSquare() {
  std::vector<Leg> legs;
  for (int side = 0; side < 4; ++side) {
    legs.push_back({{0.5, 0, 0}, 4s});
    legs.push_back({{0, 0, kPi / 4}, 2s});
  }
  return legs;
}

TEST(MotionSensors, OdometerIgnoresUnequalWheels) {
  // The robot drives around a square, as in planar_fidelity_test.cc, which names the source. The
  // sides have L = 2 m, the distance of the wheels is b, and E is the right radius divided by the
  // left one. The end differs from the start by 2 L beta along both axes, with beta = L / (b/2 (E +
  // 1) / (E - 1)). The odometry does not show this error.
  const double ratio = 1.001, left = 2 / (1 + ratio), right = 2 * ratio / (1 + ratio);
  const Driven driven = Drive(Rover("odometry", left, right), AroundTheSquare());
  ASSERT_EQ(driven.values.size(), 6u);
  EXPECT_EQ(driven.values[5], 0);  // sideways velocity; this drive cannot move sideways
  EXPECT_WITHIN(driven.values[0], 0, 1e-9, "m");
  EXPECT_WITHIN(driven.values[1], 0, 1e-9, "m");
  EXPECT_NEAR(geometry::WrapAngle(driven.values[2]), 0, 1e-9);
  const double expected = 2 * 2 * 2 / (kSeparation / 2 * (ratio + 1) / (ratio - 1));
  EXPECT_WITHIN_PERCENT(driven.pose.position.x, expected, 5);
  EXPECT_WITHIN_PERCENT(driven.pose.position.y, -expected, 5);
}

TEST(MotionSensors, AnImuOnASpinningRobotReadsCentripetalAcceleration) {
  const Driven driven = Drive(Rover("imu"), {{{0, 0, 2}, 1s}});
  ASSERT_EQ(driven.values.size(), 10u);
  EXPECT_NEAR(driven.values[2], 2, 1e-9);
  EXPECT_WITHIN(driven.values[3], -2 * 2 * 0.15, 1e-9, "m/s²");
  EXPECT_WITHIN(driven.values[4], 0, 1e-9, "m/s²");
  EXPECT_WITHIN(driven.values[5], 9.8, 1e-9, "m/s²");
}

TEST(MotionSensors, AnImuOnACirclingRobotReadsCentripetalAcceleration) {
  // At 0.5 m/s and 0.5 rad/s, the acceleration is 0.25 m/s² to the left, apart from the effect of
  // the 10 ms step.
  const Driven driven = Drive(Rover("imu"), {{{0.5, 0, 0.5}, 1s}});
  ASSERT_EQ(driven.values.size(), 10u);
  EXPECT_WITHIN(driven.values[4], 0.25, 1e-3, "m/s²");
  EXPECT_WITHIN(driven.values[3], -0.5 * 0.5 * 0.15, 2e-3, "m/s²");
}

TEST(MotionSensors, AnImuInFreeFallReadsZero) {
  auto model = Rover("imu");
  model->movement = model::Movement::kRigid;
  auto simulation = Make(Lockstep(300ms));
  RobotSpecification robot = Robot("robot", 0, 0);
  robot.model = model;
  robot.world_from_robot.position.z = 3;
  robot.on_ground = false;
  ASSERT_TRUE(simulation->AddRobot(std::move(robot)));
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
  const auto reading = simulation->Watch("robot", "imu");
  ASSERT_TRUE(reading);
  for (int i = 0; i < 3; ++i) EXPECT_WITHIN(reading->values[i], 0, 1e-6, "rad/s") << i;
  for (int i = 3; i < 6; ++i) EXPECT_WITHIN(reading->values[i], 0, 1e-6, "m/s²") << i;
  EXPECT_LT(StatusOf(*simulation, "robot").world_from_robot.position.z, 2.6);
}

TEST(MotionSensors, JointEncodersReadTheWheelAngles) {
  const Driven driven = Drive(Rover("joint_encoders"), {{{0.5, 0, 0}, 2s}});
  EXPECT_EQ(*driven.labels, (std::vector<std::string>{"left", "right"}));
  ASSERT_EQ(driven.values.size(), 4u);
  EXPECT_WITHIN(driven.values[0], 1 / kRadius, 1e-9, "rad");
  EXPECT_WITHIN(driven.values[1], 0.5 / kRadius, 1e-9, "rad");
}

TEST(MotionSensors, ABumperDetectsTheWall) {
  // The wall's face is at 2.9 m, and the robot's radius is 0.2 m.
  const Driven before = Drive(Rover("contact"), {{{0.5, 0, 0}, 1s}});
  EXPECT_TRUE(before.values.empty());
  const Driven driven = Drive(Rover("contact"), {{{0.5, 0, 0}, 2s}}, 2.0);
  EXPECT_EQ(*driven.labels, std::vector<std::string>{"wall"});
  ASSERT_EQ(driven.values.size(), 11u);
  // the distance from the sensor, which is 0.15 m ahead, to the wall's face
  EXPECT_WITHIN(driven.values[0], 0.05, 1e-3, "m");
  EXPECT_NEAR(driven.values[3], 1, 1e-6);
}

// The altimeter is on a lift, 0.1 m above its link, which starts 0.3 m above its zero position.
TEST(MotionSensors, AltimeterMeasuresFromTheStartOfItsJoints) {
  auto model = Rover("altimeter");
  model->links.push_back({});
  model::Joint lift;
  lift.name = "lift";
  lift.kind = model::JointKind::kPrismatic;
  lift.parent = 0;
  lift.child = 3;
  lift.axis = {0, 0, 1};
  lift.position_limits = {0, 1};
  model->joints.push_back(lift);
  model->sensors.front().link = 3;
  model->start_positions = {0, 0, 0.3};
  const Driven driven = Drive(model, {{{0.1, 0, 0}, 100ms}});
  EXPECT_WITHIN(driven.values[0], 0, 1e-12, "m");
  EXPECT_WITHIN(driven.values[2], 0.4, 1e-12, "m");
}

TEST(MotionSensors, BatteryDischargesWhileDriving) {
  const Driven driven = Drive(Rover("battery"), {{{0.5, 0, 0}, 4s}});
  ASSERT_EQ(driven.values.size(), 5u);
  EXPECT_WITHIN(driven.values[2], 5 - (0.5 * 4 + 4 * 2.0) / 3600, 1e-12, "Ah");
  EXPECT_WITHIN(driven.values[1], 0.5 + 4 * 0.5, 1e-9, "A");
}

}  // namespace
}  // namespace gsv::simulation
