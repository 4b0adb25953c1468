// Compares the sensors of motion, position and contact with closed forms.
#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "gsv/base/test_within.h"
#include "gsv/geometry/constants.h"
#include "gsv/messages/gsv_msgs.h"
#include "gsv/messages/nav_msgs.h"
#include "gsv/messages/ros_gz_interfaces.h"
#include "gsv/messages/sensor_msgs.h"
#include "gsv/messages/vision_msgs.h"
#include "gsv/sensing/testing/test_sensor.h"
#include "gsv/sensing/testing/test_snapshot.h"

namespace gsv::sensing {
namespace {

using geometry::PlanarPose;
using testing::BuiltInSensors;
using testing::DescriptionOf;
using ::testing::TestWithParam;

using geometry::kPi;

// A robot is at (1, 0) and faces y. It has an arm that turns about its z axis. Another robot is 3 m
// in front of it. There are also a box that hides a third robot, and a floor.
class SensorTypesTest : public ::testing::Test {
 protected:
  SensorTypesTest() {
    auto robot = testing::ModelOf(geometry::Sphere{0.1});
    robot->links.push_back({});
    model::Joint turret;
    turret.name = "turret";
    turret.kind = model::JointKind::kContinuous;
    turret.parent = 0;
    turret.child = 1;
    turret.axis = {0, 0, 1};
    robot->joints.push_back(turret);
    snapshot_ = testing::MakeSnapshot(
        {{"robot", robot, PlanarPose(1, 0, 0, kPi / 2), false},
         {"other", testing::ModelOf(geometry::Sphere{0.3}), PlanarPose(1, 3, 0.3, 0), false},
         {"box", testing::ModelOf(geometry::Box{{1, 0.2, 2}}), PlanarPose(3, 3, 0.3, 0), true},
         {"hidden", testing::ModelOf(geometry::Sphere{0.3}), PlanarPose(5, 6, 0.3, 0), false},
         {"floor", testing::ModelOf(geometry::Plane{}), {}, true}});
    body_ = snapshot_->layout->Find("robot");
    snapshot_->accelerations.resize(snapshot_->layout->bodies.size());
    auto description = std::make_shared<model::WorldDescription>();
    description->magnetic_field = {1e-5, 2e-5, -4e-5};
    auto layout = std::make_shared<world::Layout>(*snapshot_->layout);
    layout->description = world_ = description;
    snapshot_->layout = layout;
  }

  // Replaces the model of the robot. Its joints are then at their start.
  void ReplaceModel(std::shared_ptr<const model::Model> model) {
    auto bodies = snapshot_->layout->bodies;
    bodies[body_].model = std::move(model);
    snapshot_->layout = world::MakeLayout(1, std::move(bodies), world_);
    snapshot_->state = world::InitialState(*snapshot_->layout);
  }

  world::BodyState& body() { return snapshot_->state.bodies[body_]; }
  world::Acceleration& acceleration() { return snapshot_->accelerations[body_]; }

  base::Result<Reading> TrySample(const model::SensorDescription& description) {
    const auto sensor = BuiltInSensors().Find(description.type)->create(description);
    if (!sensor) return base::Fail(sensor.error());
    return (*sensor)->Sample(Sampling(snapshot_, body_, 1, rays_));
  }
  Reading Sample(const model::SensorDescription& description) {
    auto reading = TrySample(description);
    EXPECT_TRUE(reading) << reading.error().Sentence();
    return reading ? *reading : Reading();
  }
  template <typename Message>
  Message Sent(const model::SensorDescription& description) {
    const auto sensor = BuiltInSensors().Find(description.type)->create(description);
    const auto bytes = (*sensor)->Encode(Sample(description), "robot/it");
    const auto message = messages::Decode<Message>(std::as_bytes(std::span(*bytes)));
    EXPECT_TRUE(message);
    return *message;
  }

  int body_ = 0;
  std::shared_ptr<world::Snapshot> snapshot_;
  std::shared_ptr<model::WorldDescription> world_;
  RaySceneCache rays_;
};

using Units = std::vector<std::string>;
const Units kImu = {"rad/s", "rad/s", "rad/s", "m/s²", "m/s²", "m/s²"};

// Compares values that have a unit, and records their errors, see EXPECT_WITHIN.
void ExpectValues(const Reading& reading, const std::vector<double>& expected,
                  const Units& units = {}, double bound = 1e-12) {
  ASSERT_GE(reading.values.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (i < units.size()) {
      EXPECT_WITHIN(reading.values[i], expected[i], bound, units[i]) << "value " << i;
    } else {
      EXPECT_NEAR(reading.values[i], expected[i], bound) << "value " << i;
    }
  }
}

TEST_F(SensorTypesTest, ImuAtRestReadsTheSupportingForce) {
  ExpectValues(Sample(DescriptionOf("imu")), {0, 0, 0, 0, 0, 9.8}, kImu);
  // The robot lies on its right side, so the supporting force acts to its left, along its own y.
  body().world_from_model.orientation = geometry::FromRollPitchYaw({kPi / 2, 0, 0});
  ExpectValues(Sample(DescriptionOf("imu")), {0, 0, 0, 0, 9.8, 0}, kImu);
}

TEST_F(SensorTypesTest, ImuInFreeFallReadsZero) {
  acceleration().linear = {0, 0, -9.8};
  body().linear_velocity = {0, 0, -3};
  ExpectValues(Sample(DescriptionOf("imu")), {0, 0, 0, 0, 0, 0}, kImu);
}

TEST_F(SensorTypesTest, ImuOnATurntableReadsTheCentripetalAcceleration) {
  const double rate = 3;
  body().angular_velocity = {0, 0, rate};
  ExpectValues(Sample(DescriptionOf("imu")), {0, 0, rate, -rate * rate * 0.2, 0, 9.8}, kImu);
  // The turntable accelerates.
  acceleration().angular = {0, 0, 2};
  ExpectValues(Sample(DescriptionOf("imu")), {0, 0, rate, -rate * rate * 0.2, 2 * 0.2, 9.8}, kImu);
}

TEST_F(SensorTypesTest, ImuOnATurretReadsItsTurningRate) {
  auto description = DescriptionOf("imu");
  description.link = 1;
  snapshot_->state.joint_positions[0] = 1.1;
  snapshot_->state.joint_velocities[0] = 2;
  ExpectValues(Sample(description), {0, 0, 2, -4 * 0.2, 0, 9.8}, kImu);
  // The turret does not rotate in the world, because the base rotates in the opposite direction.
  body().angular_velocity = {0, 0, -2};
  ExpectValues(Sample(description), {0, 0, 0, 0, 0, 9.8}, kImu);
}

TEST_F(SensorTypesTest, ImuOnAJointReadsTheAccelerationOfTheJoint) {
  auto description = DescriptionOf("imu");
  description.link = 1;
  snapshot_->joint_accelerations = {3};
  ExpectValues(Sample(description), {0, 0, 0, 0, 3 * 0.2, 9.8}, kImu);
}

TEST_F(SensorTypesTest, ImuOnAScrewJointTurnsAndSlides) {
  auto screw = std::make_shared<model::Model>(*snapshot_->layout->bodies[body_].model);
  screw->joints[0].kind = model::JointKind::kScrew;
  screw->joints[0].thread_pitch = 0.05;
  ReplaceModel(screw);
  auto description = DescriptionOf("imu");
  description.link = 1;
  snapshot_->state.joint_velocities[0] = 2;
  snapshot_->joint_accelerations = {3};
  // It turns about the z axis, and slides along it by 0.05 m for each radian.
  ExpectValues(Sample(description), {0, 0, 2, -4 * 0.2, 3 * 0.2, 9.8 + 0.05 * 3}, kImu);
  description.type = "altimeter";
  ExpectValues(Sample(description), {0, 2 * 0.05});
}

TEST_F(SensorTypesTest, ImuOnABallJointTurnsAboutAllAxes) {
  auto ball = std::make_shared<model::Model>(*snapshot_->layout->bodies[body_].model);
  ball->links.resize(4);
  ball->joints.resize(3, ball->joints[0]);
  for (int i = 0; i < 3; ++i) {
    model::Joint& joint = ball->joints[static_cast<std::size_t>(i)];
    joint.name = "ball" + std::to_string(i);
    joint.kind = model::JointKind::kBall;
    joint.parent = i, joint.child = i + 1;
    joint.axis = {i == 0 ? 1.0 : 0.0, i == 1 ? 1.0 : 0.0, i == 2 ? 1.0 : 0.0};
  }
  ReplaceModel(ball);
  auto description = DescriptionOf("imu");
  description.link = 3;
  // The values of a ball joint are its angular velocity w. The sensor is at r = (0.2, 0, 0.3), so its
  // centripetal acceleration is w × (w × r) = w (w · r) - r (w · w), with w · r = 1.1 and w · w = 14.
  snapshot_->state.joint_velocities = {1, 2, 3};
  ExpectValues(Sample(description), {1, 2, 3, 1.1 - 14 * 0.2, 2 * 1.1, 9.8 + 3 * 1.1 - 14 * 0.3},
               kImu);
}

TEST_F(SensorTypesTest, ImuReadsItsOrientationIfEnabled) {
  const Reading reading = Sample(DescriptionOf("imu"));
  ASSERT_EQ(reading.values.size(), 10u);
  EXPECT_NEAR(reading.values[6], std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(reading.values[9], std::sqrt(0.5), 1e-12);
  const auto description = DescriptionOf("imu", {{"enable_orientation", false}});
  EXPECT_EQ(Sample(description).values.size(), 6u);
  EXPECT_EQ(Sent<messages::sensor_msgs::Imu>(description).orientation_covariance[0], -1);
  const auto message = Sent<messages::sensor_msgs::Imu>(DescriptionOf("imu"));
  EXPECT_EQ(message.header.frame_id, "robot/it");
  EXPECT_NEAR(message.linear_acceleration.z, 9.8, 1e-12);
  EXPECT_NEAR(message.orientation.z, std::sqrt(0.5), 1e-12);
}

// The robot faces y, a quarter turn from x. The world's x points 30 degrees north of east.
TEST_F(SensorTypesTest, ImuReadsItsOrientationInTheGivenFrame) {
  model::WorldDescription world = *world_;
  world.origin = model::GeodeticOrigin{0, 0, 0, kPi / 6};
  world.gravity = {0, -9.8, 0};
  auto layout = std::make_shared<world::Layout>(*snapshot_->layout);
  layout->description = std::make_shared<model::WorldDescription>(world);
  snapshot_->layout = layout;
  struct Case {
    std::string localization;
    geometry::Vector3 forward, up;  // the expected axes of the robot in the reference frame
  };
  const double c = std::cos(kPi * 2 / 3), s = std::sin(kPi * 2 / 3);
  for (const Case& expected :
       {Case{"ENU", {c, s, 0}, {0, 0, 1}}, Case{"NED", {s, c, 0}, {0, 0, -1}},
        Case{"NWU", {s, -c, 0}, {0, 0, 1}},
        // Gravity acts along the world's -y, and the robot faces y. So the robot's x axis points
        // up. Its z axis is horizontal: in the frame GRAV_UP, it is -y.
        Case{"GRAV_UP", {0, 0, 1}, {0, -1, 0}}, Case{"GRAV_DOWN", {0, 0, -1}, {0, 1, 0}},
        // This reference frame has the orientation of the robot.
        Case{"CUSTOM", {1, 0, 0}, {0, 0, 1}}}) {
    const auto values =
        Sample(DescriptionOf("imu",
                             {{"orientation_reference_frame.localization", expected.localization},
                              {"orientation_reference_frame.custom_rpy",
                               std::string("0 0 1.5707963267948966")}}))
            .values;
    ASSERT_EQ(values.size(), 10u);
    const geometry::Quaternion q{values[6], values[7], values[8], values[9]};
    EXPECT_LT(Norm(q * geometry::Vector3{1, 0, 0} - expected.forward), 1e-9)
        << expected.localization;
    EXPECT_LT(Norm(q * geometry::Vector3{0, 0, 1} - expected.up), 1e-9) << expected.localization;
  }
}

TEST_F(SensorTypesTest, MagnetometerRotatesTheFieldIntoItsFrame) {
  // The robot faces y, so its x is the world's y, and its y is the world's -x.
  ExpectValues(Sample(DescriptionOf("magnetometer")), {2e-5, -1e-5, -4e-5}, {"T", "T", "T"}, 1e-18);
  EXPECT_NEAR(
      Sent<messages::sensor_msgs::MagneticField>(DescriptionOf("magnetometer")).magnetic_field.x,
      2e-5, 1e-18);
}

TEST_F(SensorTypesTest, AltimeterMeasuresFromItsInitialHeight) {
  body().world_from_model.position.z += 2;
  body().linear_velocity = {5, 0, -0.5};
  ExpectValues(Sample(DescriptionOf("altimeter")), {2, -0.5, 0.3}, {"m", "m/s", "m"});
  ExpectValues(Sample(DescriptionOf("altimeter", {{"vertical_reference", -1.0}})), {3.3, -0.5, -1},
               {"m", "m/s", "m"});
  EXPECT_EQ(
      Sent<messages::ros_gz_interfaces::Altimeter>(DescriptionOf("altimeter")).vertical_velocity,
      -0.5);
}

TEST_F(SensorTypesTest, GnssReceiverNeedsAGeographicOrigin) {
  const auto reading = TrySample(DescriptionOf("navsat"));
  ASSERT_FALSE(reading);
  EXPECT_NE(reading.error().Sentence().find("<spherical_coordinates>"), std::string::npos);
}

TEST_F(SensorTypesTest, GnssReceiverReadsPositionAndVelocity) {
  world_->origin = {.latitude = 0, .longitude = 0, .elevation = 100, .heading = 0};
  body().linear_velocity = {1, 2, 3};
  // The receiver is on the equator, 1 m east and 0.2 m north of the origin, and 100.3 m above it.
  const double a = 6378137.0 + 100.3, e2 = (2 - 1 / 298.257223563) / 298.257223563;
  const Reading reading = Sample(DescriptionOf("navsat"));
  ExpectValues(reading, {0.2 / (6378137.0 * (1 - e2) + 100.3) * 180 / kPi, 1 / a * 180 / kPi},
               {"°", "°"});
  EXPECT_NEAR(reading.values[2], 100.3, 1e-6);
  EXPECT_EQ(reading.values[3], 1);
  EXPECT_EQ(reading.values[4], 2);
  EXPECT_EQ(reading.values[5], 3);
  const auto description =
      DescriptionOf("gps", {{"position_sensing.horizontal.noise.stddev", 2.0}});
  const auto message = Sent<messages::sensor_msgs::NavSatFix>(description);
  EXPECT_EQ(message.position_covariance[0], 4);
  EXPECT_NEAR(message.altitude, 100.3, 1e-4);
}

TEST_F(SensorTypesTest, OdometerReadsTheWheelOdometry) {
  body().odometry = {{1, 2, 0, 1}, 0.5, 0.1};
  ExpectValues(Sample(DescriptionOf("odometry")), {1, 2, kPi / 2, 0.5, 0.1});
  const auto message = Sent<messages::nav_msgs::Odometry>(DescriptionOf("odometry"));
  EXPECT_EQ(message.header.frame_id, "robot/odom");
  EXPECT_EQ(message.child_frame_id, "robot/base_link");
  EXPECT_EQ(message.pose.pose.position.y, 2);
  EXPECT_NEAR(message.pose.pose.orientation.w, std::sqrt(0.5), 1e-12);
  EXPECT_EQ(message.twist.twist.linear.x, 0.5);
}

TEST_F(SensorTypesTest, BumperReadsTheContactPoint) {
  EXPECT_TRUE(Sample(DescriptionOf("bumper")).values.empty());
  const int other = snapshot_->layout->Find("other"), floor = snapshot_->layout->Find("floor");
  // There are three contacts: with the other robot straight ahead, with the floor below, and with a
  // vertical face of the floor's body behind. In the first contact, this robot is the second body.
  snapshot_->contacts = {{other, body_, {1, 0.5, 0.3}, {0, -1, 0}, 0.01, true, 0.4},
                         {body_, floor, {1, 0, 0}, {0, 0, -1}, 0.001},
                         {body_, floor, {1, -0.5, 0.3}, {0, -1, 0}, 0.02}};
  const Reading all = Sample(DescriptionOf("contact"));
  ASSERT_EQ(all.values.size(), 22u);
  EXPECT_EQ(*all.labels, (std::vector<std::string>{"other", "floor"}));
  ExpectValues(all,
               {0.3, 0, 0, 1, 0, 0, 0.01, 0.4, 0, 0, 0, -0.7, 0, 0, -1, 0, 0, 0.02, 0, 0, 0, 0});
  const Reading ahead = Sample(DescriptionOf("contact", {{"field_of_view", kPi}}));
  EXPECT_EQ(*ahead.labels, std::vector<std::string>{"other"});
  EXPECT_EQ(Sample(DescriptionOf("contact", {{"ground", true}})).values.size(), 33u);
  // A body that supports the robot counts as ground, even if the normal is not vertical.
  snapshot_->contacts[2].supports = true;
  EXPECT_EQ(Sample(DescriptionOf("contact")).values.size(), 11u);
  EXPECT_EQ(Sample(DescriptionOf("contact", {{"ground", true}})).values.size(), 33u);
  snapshot_->contacts[2].supports = false;
  const auto message = Sent<messages::gsv_msgs::Bumper>(DescriptionOf("contact"));
  ASSERT_EQ(message.contacts.size(), 2u);
  EXPECT_EQ(message.contacts[0].other, "other");
  EXPECT_NEAR(message.contacts[0].point.x, 0.3, 1e-12);
  EXPECT_EQ(message.contacts[0].closing_speed, 0.4);
  const auto bumper = BuiltInSensors().Find("contact")->create(DescriptionOf("contact"));
  const auto lines = (*bumper)->Beams(all);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_NEAR(lines[0].from.x, 0.3, 1e-12);
}

// The bumper reads the force on the robot, whether the robot is the first or the second body of the
// contact.
TEST_F(SensorTypesTest, BumperReadsTheForceOnTheRobot) {
  const int other = snapshot_->layout->Find("other"), floor = snapshot_->layout->Find("floor");
  snapshot_->step_length = std::chrono::milliseconds(10);
  snapshot_->contacts = {{other, body_, {1, 0.5, 0.3}, {0, -1, 0}},
                         {body_, floor, {1, -0.5, 0.3}, {0, -1, 0}}};
  snapshot_->contacts[0].points = {{{1, 0.5, 0.3}, {0, -1, 0}, 0, {0.01, -0.2, 0}}};
  snapshot_->contacts[1].impulse = 0.3;  // without contact points, the force is along the normal
  const Reading reading = Sample(DescriptionOf("contact"));
  ASSERT_EQ(reading.values.size(), 22u);
  // The robot faces the world's y axis.
  EXPECT_NEAR(reading.values[8], -20, 1e-12);
  EXPECT_NEAR(reading.values[9], -1, 1e-12);
  EXPECT_NEAR(reading.values[10], 0, 1e-12);
  EXPECT_NEAR(reading.values[19], 30, 1e-12);
  const auto message = Sent<messages::gsv_msgs::Bumper>(DescriptionOf("contact"));
  EXPECT_NEAR(message.contacts[0].force.x, -20, 1e-12);
}

// A body has one plate in front and one plate behind. The front plate touches a wall.
class NamedCollisionsTest : public ::testing::Test {
 protected:
  NamedCollisionsTest() {
    auto robot = std::make_shared<model::Model>();
    robot->links.resize(1);
    const auto add = [&](const char* name, const geometry::Vector3& size, double x) {
      model::Collision collision;
      collision.name = name;
      collision.link_from_collision = {{x, 0, 0.1}, {}};
      collision.shape = geometry::Box{size};
      robot->links[0].collisions.push_back(collision);
    };
    add("body", {0.4, 0.3, 0.2}, 0), add("front", {0.02, 0.3, 0.1}, 0.21);
    add("rear", {0.02, 0.3, 0.1}, -0.21);
    snapshot_ = testing::MakeSnapshot(
        {{"robot", robot, PlanarPose(1, 0, 0, 0), false},
         {"wall", testing::ModelOf(geometry::Box{{1, 8, 1}}), PlanarPose(1.72, 0, 0, 0), true}});
    const int body = snapshot_->layout->Find("robot"), wall = snapshot_->layout->Find("wall");
    snapshot_->contacts = {{body, wall, {1.22, 0.1, 0.1}, {1, 0, 0}, 0.001}};
  }

  std::size_t ContactsOf(const std::string& collisions) {
    const auto description = DescriptionOf("contact", {{"collision", collisions}});
    const auto bumper = BuiltInSensors().Find("contact")->create(description);
    EXPECT_TRUE(bumper);
    const auto reading =
        (*bumper)->Sample(Sampling(snapshot_, snapshot_->layout->Find("robot"), 1, rays_));
    return reading->labels->size();
  }

  std::shared_ptr<world::Snapshot> snapshot_;
  RaySceneCache rays_;
};

TEST_F(NamedCollisionsTest, BumperReadsTheNamedCollisions) {
  EXPECT_EQ(ContactsOf("front"), 1u);
  EXPECT_EQ(ContactsOf("rear"), 0u);
  EXPECT_EQ(ContactsOf("body"), 0u);
  EXPECT_EQ(ContactsOf("rear\nfront"), 1u);
  EXPECT_EQ(ContactsOf("robot::front"), 0u);  // no link has that name
}

TEST_F(NamedCollisionsTest, BumperReadsEachPointOfAContact) {
  snapshot_->contacts[0].points = {{{1.22, 0.1, 0.1}, {1, 0, 0}, 0.001},
                                   {{1.22, -0.1, 0.1}, {1, 0, 0}, 0.0005}};
  EXPECT_EQ(ContactsOf("front"), 2u);
  EXPECT_EQ(ContactsOf(""), 2u);
  EXPECT_EQ(ContactsOf("rear"), 0u);
}

TEST_F(NamedCollisionsTest, BumperReadsTheSupportOfItsNamedCollision) {
  snapshot_->contacts[0].normal = {0, 0, -1};
  snapshot_->contacts[0].supports = true;
  EXPECT_EQ(ContactsOf("front"), 1u);
  EXPECT_EQ(ContactsOf(""), 0u);
}

TEST_F(NamedCollisionsTest, BumperWithoutNamesReadsAllCollisions) {
  EXPECT_EQ(ContactsOf(""), 1u);
  EXPECT_EQ(ContactsOf("__default__"), 1u);
}

TEST_F(NamedCollisionsTest, BumperWithAnUnknownNameReadsNothing) {
  EXPECT_EQ(ContactsOf("bumper"), 0u);
}

TEST_F(SensorTypesTest, JointEncodersCountTurns) {
  snapshot_->state.joint_positions[0] = 1.0;
  snapshot_->state.joint_velocities[0] = -0.5;
  const Reading reading = Sample(DescriptionOf("joint_state"));
  ExpectValues(reading, {1, -0.5}, {"rad", "rad/s"});
  EXPECT_EQ(*reading.labels, std::vector<std::string>{"turret"});
  // With a hundred counts per turn, 1 rad is fifteen counts.
  ExpectValues(Sample(DescriptionOf("joint_encoders", {{"counts_per_turn", 100.0}})),
               {15 * 2 * kPi / 100, -0.5}, {"rad", "rad/s"});
  const auto message = Sent<messages::sensor_msgs::JointState>(DescriptionOf("joint_encoders"));
  EXPECT_EQ(message.name, std::vector<std::string>{"turret"});
  EXPECT_EQ(message.position, std::vector<double>{1.0});
  const auto missing = TrySample(DescriptionOf("joint_encoders", {{"joint", std::string("knee")}}));
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().Sentence(), "robot/front: the robot has no joint \"knee\" that moves");
}

TEST_F(SensorTypesTest, JointEncodersReportTheAngleOfAScrewJoint) {
  auto layout = std::make_shared<world::Layout>(*snapshot_->layout);
  auto model = std::make_shared<model::Model>(*layout->bodies[body_].model);
  model->joints[0].kind = model::JointKind::kScrew;
  model->joints[0].thread_pitch = 0.01;
  layout->bodies[body_].model = model;
  snapshot_->layout = layout;
  snapshot_->state.joint_positions[0] = 3.0;
  snapshot_->state.joint_velocities[0] = 0.25;
  const Reading reading = Sample(DescriptionOf("joint_encoders"));
  ExpectValues(reading, {3, 0.25}, {"rad", "rad/s"});
  EXPECT_EQ(*reading.labels, std::vector<std::string>{"turret"});
}

TEST_F(SensorTypesTest, BatteryDischargesWithTimeAndDistance) {
  const model::Parameters parameters = {{"capacity", 2.0},       {"voltage_full", 12.0},
                                        {"voltage_empty", 10.0}, {"resistance", 0.5},
                                        {"idle_current", 1.0},   {"drive_charge", 6.0}};
  snapshot_->state.time = std::chrono::minutes(30);
  body().distance = 300;
  body().linear_velocity = {0, 0.5, 0};
  // Half an hour at 1 A takes 0.5 Ah, and 300 m take another 0.5 Ah, so 1 of 2 Ah remains. The
  // current is 1 A + 3 A per m/s.
  ExpectValues(Sample(DescriptionOf("battery", parameters)), {11 - 0.5 * 4, 4, 1, 2, 0.5},
               {"V", "A", "Ah", "Ah"});
  const auto message =
      Sent<messages::sensor_msgs::BatteryState>(DescriptionOf("battery", parameters));
  EXPECT_EQ(message.current, -4);
  EXPECT_EQ(message.percentage, 0.5f);
  // The robot was added after a quarter of an hour.
  body().since = std::chrono::minutes(15);
  ExpectValues(Sample(DescriptionOf("battery", parameters)), {11.25 - 0.5 * 4, 4, 1.25, 2, 0.625});
  body().distance = 1e6;
  ExpectValues(Sample(DescriptionOf("battery", parameters)), {0, 0, 0, 2, 0});
}

TEST_F(SensorTypesTest, LogicalCameraListsTheModelsInView) {
  auto wide = DescriptionOf("logical_camera", {{"horizontal_fov", 2.0}});
  const Reading reading = Sample(wide);
  // The box to the right is in view and hides the robot behind it. The floor is not listed, because
  // a plane has no centre.
  EXPECT_EQ(*reading.labels, (std::vector<std::string>{"box", "other"}));
  // From (1, 0.2, 0.3) and facing y, the other robot at (1, 3, 0.3) is 2.8 m ahead and turned to
  // the right.
  ASSERT_EQ(reading.values.size(), 12u);
  EXPECT_NEAR(reading.values[6], 2.8, 1e-12);
  EXPECT_NEAR(reading.values[7], 0, 1e-12);
  EXPECT_NEAR(reading.values[11], -kPi / 2, 1e-12);
  wide.parameters["occlusion"] = false;
  EXPECT_EQ(*Sample(wide).labels, (std::vector<std::string>{"box", "hidden", "other"}));
  wide.parameters["far"] = 2.0;
  EXPECT_TRUE(Sample(wide).labels->empty());
  wide.parameters["far"] = 3.0, wide.parameters["horizontal_fov"] = 1.0;
  EXPECT_EQ(*Sample(wide).labels, std::vector<std::string>{"other"});
  const auto message = Sent<messages::vision_msgs::Detection3DArray>(wide);
  ASSERT_EQ(message.detections.size(), 1u);
  EXPECT_EQ(message.detections[0].id, "other");
  EXPECT_NEAR(message.detections[0].bbox.center.position.x, 2.8, 1e-12);
}

// A value must not depend on the sensors that were read before, and must differ for another seed.
TEST_F(SensorTypesTest, NoiseDoesNotDependOnOtherReadings) {
  const std::vector<model::SensorDescription> all = {
      DescriptionOf("imu", {{"angular_velocity.x.noise.stddev", 1.0},
                            {"linear_acceleration.z.noise.dynamic_bias_stddev", 1.0},
                            {"linear_acceleration.z.noise.dynamic_bias_correlation_time", 5.0}}),
      DescriptionOf("magnetometer", {{"x.noise.stddev", 1e-6}}),
      DescriptionOf("altimeter", {{"vertical_position.noise.bias_stddev", 1.0}}),
      DescriptionOf("odometry", {{"linear.noise.stddev", 1.0}}),
      DescriptionOf("battery", {{"voltage.noise.stddev", 1.0}}),
      DescriptionOf("joint_encoders", {{"position.noise.stddev", 1.0}})};
  const auto values = [&](std::size_t i, std::uint64_t seed) {
    const auto sensor = BuiltInSensors().Find(all[i].type)->create(all[i]);
    const Reading reading = *(*sensor)->Sample(Sampling(snapshot_, body_, seed, rays_));
    return std::vector<double>(reading.values.begin(), reading.values.end());
  };
  std::vector<std::vector<double>> forwards;
  for (std::size_t i = 0; i < all.size(); ++i) forwards.push_back(values(i, 1));
  for (std::size_t i = all.size(); i-- > 0;) {
    EXPECT_EQ(values(i, 1), forwards[i]) << all[i].type;
    EXPECT_NE(values(i, 2), forwards[i]) << all[i].type;
  }
}

using Refused = std::tuple<const char*, const char*, model::ParameterValue>;

class RefusedParameter : public TestWithParam<Refused> {};

TEST_P(RefusedParameter, IsNamedInTheError) {
  const auto& [type, parameter, value] = GetParam();
  const auto sensor =
      BuiltInSensors().Find(type)->create(DescriptionOf(type, {{parameter, value}}));
  ASSERT_FALSE(sensor);
  EXPECT_NE(sensor.error().Sentence().find(parameter), std::string::npos)
      << sensor.error().Sentence();
}

INSTANTIATE_TEST_SUITE_P(
    Family, RefusedParameter,
    ::testing::Values(
        Refused{"imu", "angular_velocity.x.noise.stddev", -1.0},
        Refused{"imu", "linear_acceleration.z.noise.mean", std::nan("")},
        Refused{"imu", "enable_orientation", std::string("perhaps")},
        Refused{"imu", "orientation_reference_frame.localization", std::string("NORTH")},
        Refused{"magnetometer", "y.noise.precision", -1.0},
        Refused{"altimeter", "vertical_reference", std::numeric_limits<double>::infinity()},
        Refused{"navsat", "position_sensing.vertical.noise.dropout_probability", 1.5},
        Refused{"odometry", "linear.noise.outlier_probability", -0.1},
        Refused{"contact", "field_of_view", 7.0}, Refused{"joint_encoders", "joint", 3.0},
        Refused{"joint_encoders", "counts_per_turn", -1.0}, Refused{"battery", "capacity", 0.0},
        Refused{"battery", "voltage_empty", 13.0}, Refused{"logical_camera", "near", 11.0},
        Refused{"logical_camera", "horizontal_fov", 4.0}));

}  // namespace
}  // namespace gsv::sensing
