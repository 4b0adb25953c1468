#include "gsv/ros2/bridge.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "gsv/messages/geometry_msgs.h"
#include "gsv/messages/nav_msgs.h"
#include "gsv/messages/rosgraph_msgs.h"
#include "gsv/messages/sensor_msgs.h"
#include "gsv/messages/std_msgs.h"
#include "gsv/messages/tf2_msgs.h"
#include "gsv/messages/time.h"
#include "gsv/messages/trajectory_msgs.h"
#include "gsv/readings/catalogue.h"
#include "gsv/ros2/node.h"
#include "gsv/ros2/testing/peer.h"
#include "gsv/simulation/testing/test_simulation.h"

// Switches off a report of AddressSanitizer: Fast DDS 2.9 deletes objects through a base type of
// another size.
#if defined(__SANITIZE_ADDRESS__)
extern "C" const char* __asan_default_options() { return "new_delete_type_mismatch=0"; }
#endif

namespace gsv::ros2 {
namespace {

using testing::Peer;

// Publishes a simulation in real time to another participant, `peer_`. The robot "robot" starts at
// the origin.
class BridgeTest : public ::testing::Test {
 protected:
  void SetUp() override {
    auto specification = simulation::Lockstep(base::SimTime(0));
    specification.mode = simulation::Mode::kRealTime;
    simulation_ = simulation::Make(std::move(specification));
    ASSERT_TRUE(simulation_->AddRobot(simulation::Robot("robot", 0, 0)));
    participant_ = testing::MakeParticipant(true);
    ASSERT_NE(participant_, nullptr);
    peer_ = std::make_unique<Peer>(true);
  }
  void TearDown() override {
    bridge_.reset();
    (void)simulation_->Stop();
  }
  void Publish(Options options = {}) {
    bridge_ = Bridge::Start(*participant_, std::move(options), simulation_);
  }

  std::shared_ptr<simulation::Simulation> simulation_;
  std::unique_ptr<dds::Participant> participant_;
  std::unique_ptr<Peer> peer_;
  std::unique_ptr<Bridge> bridge_;
};

TEST_F(BridgeTest, PublishesClockOdometryAndRange) {
  Publish();
  peer_->Listen("/clock", "rosgraph_msgs/msg/Clock", kClockQos);
  peer_->Listen("/robot/odom", "nav_msgs/msg/Odometry", kDefaultQos);
  peer_->Listen("/robot/range", "sensor_msgs/msg/Range", kSensorDataQos);
  ASSERT_TRUE(simulation_->Start());
  const auto clock = peer_->Await<messages::rosgraph_msgs::Clock>("/clock", 3);
  EXPECT_EQ(clock.clock.nanosec % 10'000'000, 0u);
  const auto odometry = peer_->Await<messages::nav_msgs::Odometry>("/robot/odom");
  EXPECT_EQ(odometry.header.frame_id, "robot/odom");
  EXPECT_EQ(odometry.child_frame_id, "robot/base");
  EXPECT_EQ(odometry.pose.pose.position.x, 0);
  EXPECT_EQ(odometry.pose.pose.orientation.w, 1);
  const auto range = peer_->Await<messages::sensor_msgs::Range>("/robot/range");
  EXPECT_NEAR(range.range, 2.9, 1e-6);  // distance to the near side of the wall
  EXPECT_EQ(range.header.frame_id, "robot/front");
}

// Creates and destroys 40 participants. On one machine, discovery searches only for participants
// with the lowest 32 indices. Participants that are created later must still find each other.
TEST(Participant, IsFoundAfterManyOthers) {
  for (int i = 0; i < 40; ++i) ASSERT_NE(testing::MakeParticipant(), nullptr);
  Peer one, other;
  one.Listen("/topic", "geometry_msgs/msg/Twist", kDefaultQos);
  (void)other.Talk("/topic", "geometry_msgs/msg/Twist");
}

TEST_F(BridgeTest, PublishesFramesToLateReaders) {
  Publish();
  ASSERT_TRUE(simulation_->Start());
  peer_->Listen("/tf_static", "tf2_msgs/msg/TFMessage", kLatchedQos);
  peer_->Listen("/tf", "tf2_msgs/msg/TFMessage", kTransformQos);
  const auto fixed = peer_->Await<messages::tf2_msgs::TFMessage>("/tf_static");
  ASSERT_EQ(fixed.transforms.size(), 2u);
  EXPECT_EQ(fixed.transforms[0].child_frame_id, "robot/base_link");
  EXPECT_EQ(fixed.transforms[1].header.frame_id, "robot/base");
  EXPECT_EQ(fixed.transforms[1].child_frame_id, "robot/front");
  EXPECT_EQ(fixed.transforms[1].transform.translation.z, 0.25);
  const auto moving = peer_->Await<messages::tf2_msgs::TFMessage>("/tf");
  ASSERT_EQ(moving.transforms.size(), 1u);
  EXPECT_EQ(moving.transforms[0].header.frame_id, "robot/odom");
  EXPECT_EQ(moving.transforms[0].child_frame_id, "robot/base");
}

TEST_F(BridgeTest, SendsTheDescriptionOfARobotToLateReaders) {
  Publish();
  peer_->Listen("/robot/robot_description", "std_msgs/msg/String", kLatchedQos);
  const auto text = peer_->Await<messages::std_msgs::String>("/robot/robot_description");
  EXPECT_NE(text.data.find("<link name=\"base\""), std::string::npos) << text.data;
  Peer late;
  late.Listen("/robot/robot_description", "std_msgs/msg/String", kLatchedQos);
  EXPECT_EQ(late.Await<messages::std_msgs::String>("/robot/robot_description").data, text.data);
}

TEST_F(BridgeTest, DrivesARobotByCmdVel) {
  Publish();
  ASSERT_TRUE(simulation_->Start());
  peer_->Listen("/robot/ground_truth/pose", "geometry_msgs/msg/PoseStamped", kDefaultQos);
  const auto writer = peer_->Talk("/robot/cmd_vel", "geometry_msgs/msg/Twist");
  messages::geometry_msgs::Twist twist;
  twist.linear.x = 2;
  messages::Bytes bytes;
  messages::Encode(twist, bytes);
  writer->Write(bytes);
  double x = 0;
  for (std::size_t count = 1; x < 1 && count < 500; ++count) {
    x = peer_->Await<messages::geometry_msgs::PoseStamped>("/robot/ground_truth/pose", count)
            .pose.position.x;
    if (::testing::Test::HasFailure()) break;
  }
  EXPECT_GE(x, 1);
}

// A robot with one joint. The joint lifts the robot by up to half a metre.
std::shared_ptr<const model::Model> Lift() {
  auto lift = std::make_shared<model::Model>(*simulation::Disc(0.2));
  model::Link fork;
  fork.name = "fork";
  lift->links.push_back(fork);
  model::Joint joint;
  joint.name = "lift";
  joint.kind = model::JointKind::kPrismatic;
  joint.axis = {0, 0, 1};
  joint.parent = 0;
  joint.child = 1;
  joint.position_limits = {0, 0.5};
  lift->joints = {joint};
  return lift;
}

// A trajectory that takes the lift to a position (m) in `seconds`.
messages::Bytes LiftedTo(double position, double seconds) {
  messages::trajectory_msgs::JointTrajectory trajectory;
  trajectory.joint_names = {"lift"};
  trajectory.points.resize(1);
  trajectory.points[0].positions = {position};
  const auto whole = std::floor(seconds);
  trajectory.points[0].time_from_start.sec = static_cast<std::int32_t>(whole);
  trajectory.points[0].time_from_start.nanosec =
      static_cast<std::uint32_t>(1e9 * (seconds - whole));
  messages::Bytes bytes;
  messages::Encode(trajectory, bytes);
  return bytes;
}

TEST_F(BridgeTest, MovesJointsAlongATrajectory) {
  auto robot = simulation::Robot("lift", 0, 3);
  robot.model = Lift();
  ASSERT_TRUE(simulation_->AddRobot(robot));
  Publish();
  ASSERT_TRUE(simulation_->Start());
  peer_->Listen("/lift/joint_states", "sensor_msgs/msg/JointState", kDefaultQos);
  const auto writer = peer_->Talk("/lift/joint_trajectory", "trajectory_msgs/msg/JointTrajectory");
  writer->Write(LiftedTo(0.3, 0.5));
  double position = 0;
  for (std::size_t count = 1; position < 0.299 && count < 500; ++count) {
    const auto state = peer_->Await<messages::sensor_msgs::JointState>("/lift/joint_states", count);
    ASSERT_EQ(state.name, std::vector<std::string>{"lift"});
    position = state.position.at(0);
  }
  EXPECT_NEAR(position, 0.3, 1e-3);
}

TEST_F(BridgeTest, AResetEndsATrajectory) {
  auto robot = simulation::Robot("lift", 0, 3);
  robot.model = Lift();
  ASSERT_TRUE(simulation_->AddRobot(robot));
  Publish();
  ASSERT_TRUE(simulation_->Start());
  peer_->Listen("/lift/joint_states", "sensor_msgs/msg/JointState", kDefaultQos);
  const auto writer = peer_->Talk("/lift/joint_trajectory", "trajectory_msgs/msg/JointTrajectory");
  writer->Write(LiftedTo(0.5, 2));
  std::size_t count = 0;
  const auto next = [&] {
    return peer_->Await<messages::sensor_msgs::JointState>("/lift/joint_states", ++count);
  };
  const auto time_of = [](const messages::sensor_msgs::JointState& state) {
    return messages::ToSimTime(state.header.stamp);
  };
  messages::sensor_msgs::JointState state;
  while (!HasFailure() && (state.position.empty() || state.position[0] < 0.2)) state = next();
  ASSERT_TRUE(simulation_->Stop());
  ASSERT_TRUE(simulation_->Reset());
  ASSERT_TRUE(simulation_->Start());
  for (auto before = time_of(state); !HasFailure() && time_of(state) >= before; state = next()) {
    before = time_of(state);
  }
  // A command that was on its way during the reset may still move the joint once.
  while (!HasFailure() && time_of(state) < std::chrono::milliseconds(300)) state = next();
  const double position = state.position.at(0);
  while (!HasFailure() && time_of(state) < std::chrono::seconds(1)) {
    ASSERT_EQ(state.position.at(0), position);
    state = next();
  }
}

TEST_F(BridgeTest, PublishesLidarsWithOneAndWithSeveralRowsOnTheirUsualTopics) {
  auto model = std::make_shared<model::Model>(*simulation::Disc(0.2));
  model->sensors.resize(2, model->sensors[0]);
  for (std::size_t i = 0; i < 2; ++i) {
    model->sensors[i].name = i == 0 ? "front" : "top";
    model->sensors[i].type = readings::Lidar::kType;
    model->sensors[i].parameters = {{"scan.vertical.samples", i == 0 ? 1.0 : 4.0},
                                    {"scan.vertical.min_angle", -0.1},
                                    {"scan.vertical.max_angle", 0.1}};
  }
  auto robot = simulation::Robot("scanner", 0, 3);
  robot.model = model;
  ASSERT_TRUE(simulation_->AddRobot(robot));
  Publish();
  ASSERT_TRUE(simulation_->Start());
  peer_->Listen("/scanner/scan", "sensor_msgs/msg/LaserScan", kSensorDataQos);
  EXPECT_EQ(peer_->Await<messages::sensor_msgs::LaserScan>("/scanner/scan").header.frame_id,
            "scanner/front");
  peer_->Listen("/scanner/points", "sensor_msgs/msg/PointCloud2", kLargeDataQos);
  EXPECT_EQ(peer_->Await<messages::sensor_msgs::PointCloud2>("/scanner/points").header.frame_id,
            "scanner/top");
}

TEST_F(BridgeTest, PublishesACameraAndAWideAngleCameraOnDifferentTopics) {
  // This library has no cameras, so IMUs have the names of the types.
  auto sensors = std::make_shared<sensing::SensorRegistry>();
  sensing::AddBuiltInSensors(*sensors);
  for (const char* const name : {readings::Camera::kType, readings::Camera::kWideAngleType}) {
    sensing::SensorType type = *sensors->Find(readings::Imu::kType);
    type.name = name;
    type.aliases.clear();
    ASSERT_TRUE(sensors->Add(std::move(type)));
  }
  auto specification = simulation::Lockstep(base::SimTime(0));
  specification.mode = simulation::Mode::kRealTime;
  simulation_ = *simulation::Simulation::Create(std::move(specification), sensors);
  auto model = std::make_shared<model::Model>(*simulation::Disc(0.2));
  model->sensors.resize(2, model->sensors[0]);
  model->sensors[0].name = "narrow";
  model->sensors[0].type = readings::Camera::kType;
  model->sensors[1].name = "wide";
  model->sensors[1].type = readings::Camera::kWideAngleType;
  auto robot = simulation::Robot("robot", 0, 0);
  robot.model = model;
  ASSERT_TRUE(simulation_->AddRobot(robot));
  Publish();
  ASSERT_TRUE(simulation_->Start());
  for (const std::string camera : {"narrow", "wide"}) {
    const std::string topic = "/robot/" + camera + "/image_raw/compressed";
    peer_->Listen(topic, "sensor_msgs/msg/Imu", kLargeDataQos);
    EXPECT_EQ(peer_->Await<messages::sensor_msgs::Imu>(topic).header.frame_id,
              "robot/" + camera + "/optical");
  }
}

TEST_F(BridgeTest, IgnoresBytesThatAreNotACommand) {
  Publish();
  ASSERT_TRUE(simulation_->Start());
  const auto writer = peer_->Talk("/robot/cmd_vel", "geometry_msgs/msg/Twist");
  for (const std::size_t size : {4, 5, 12, 51, 4096}) {
    writer->Write(messages::Bytes(size, std::byte{0xff}));
  }
  peer_->Listen("/robot/odom", "nav_msgs/msg/Odometry", kDefaultQos);
  const auto odometry = peer_->Await<messages::nav_msgs::Odometry>("/robot/odom", 5);
  EXPECT_EQ(odometry.twist.twist.linear.x, 0);
}

TEST_F(BridgeTest, PutsARobotIntoAnotherNamespace) {
  Publish({.namespaces = {{"robot", "/"}}});
  ASSERT_TRUE(simulation_->Start());
  peer_->Listen("/odom", "nav_msgs/msg/Odometry", kDefaultQos);
  const auto odometry = peer_->Await<messages::nav_msgs::Odometry>("/odom");
  EXPECT_EQ(odometry.header.frame_id, "odom");
  EXPECT_EQ(odometry.child_frame_id, "base");
}

TEST_F(BridgeTest, PublishesARobotThatIsAddedLater) {
  Publish();
  ASSERT_TRUE(simulation_->Start());
  ASSERT_TRUE(simulation_->AddRobot(simulation::Robot("late", 0, 3)));
  peer_->Listen("/late/odom", "nav_msgs/msg/Odometry", kDefaultQos);
  EXPECT_EQ(peer_->Await<messages::nav_msgs::Odometry>("/late/odom").header.frame_id, "late/odom");
}

TEST_F(BridgeTest, TakesNoCommandsForARobotWithABehaviour) {
  ASSERT_TRUE(simulation_->AddRobot(simulation::Robot("driven", 0, 3, simulation::Drives(0))));
  Publish();
  ASSERT_TRUE(simulation_->Start());
  peer_->Listen("/driven/odom", "nav_msgs/msg/Odometry", kDefaultQos);
  (void)peer_->Await<messages::nav_msgs::Odometry>("/driven/odom");
  // Waits until the peer has discovered a reader of commands: that of the robot without a
  // behaviour.
  (void)peer_->Talk("/robot/cmd_vel", "geometry_msgs/msg/Twist");
  for (const dds::Endpoint& endpoint : peer_->participant().endpoints()) {
    EXPECT_NE(endpoint.topic.name, "rt/driven/cmd_vel");
  }
}

}  // namespace
}  // namespace gsv::ros2
