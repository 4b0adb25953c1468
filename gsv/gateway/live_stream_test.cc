#include "gsv/gateway/live_stream.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <set>
#include <thread>

#include <gtest/gtest.h>

#include "gsv/gateway/testing/recording_client.h"
#include "gsv/gateway/testing/scripted_simulation.h"
#include "gsv/messages/gsv_msgs.h"
#include "gsv/messages/rosgraph_msgs.h"
#include "gsv/messages/sensor_msgs.h"
#include "gsv/messages/tf2_msgs.h"
#include "gsv/messages/time.h"
#include "gsv/messages/visualization_msgs.h"

namespace gsv::gateway {
namespace {

using messages::gsv_msgs::LifecycleEvent;
using messages::gsv_msgs::Poses;
using messages::gsv_msgs::SimulationStatus;
using messages::tf2_msgs::TFMessage;
using messages::visualization_msgs::MarkerArray;
using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::Decoded;
using testing::ReceivedData;
using testing::RecordingClient;
using testing::ScriptedSimulation;

// One robot on a circle of radius 1 at 0.2 rad/s, and wall time that a test lets pass.
class LiveStreamTest : public ::testing::Test {
 protected:
  void SetUp() override { stream_.hub()->Add(client_); }
  void TearDown() override { workers_.Stop(); }

  void Round(milliseconds later = milliseconds(34)) {
    now_ += later;
    stream_.Round(simulation_, now_);
  }

  void Subscribe(foxglove::SubscriptionId id, const std::string& topic) {
    Subscribe(*client_, id, topic);
  }
  void Subscribe(RecordingClient& client, foxglove::SubscriptionId id, const std::string& topic) {
    const foxglove::ChannelId channel = client.ChannelOf(topic);
    ASSERT_NE(channel, 0u) << topic;
    ASSERT_TRUE(stream_.hub()->Receive(&client, testing::SubscribeText(id, channel)));
  }

  // For what workers do: rounds until that many messages of the subscription have come.
  ReceivedData RoundUntil(foxglove::SubscriptionId id, std::size_t count) {
    while (client_->data(id).size() < count) {
      Round(milliseconds(1));
      std::this_thread::yield();
    }
    return client_->data(id)[count - 1];
  }

  std::size_t Complaints(const std::string& sentence) const {
    const auto texts = client_->texts();
    return static_cast<std::size_t>(
        std::count_if(texts.begin(), texts.end(),
                      [&](const auto& text) { return text.value("message", "") == sentence; }));
  }

  WallTime now_{};
  WorkerPool workers_{1, 8};
  std::shared_ptr<ScriptedSimulation> simulation_ =
      std::make_shared<ScriptedSimulation>("arena", 1);
  LiveStream stream_{simulation_, workers_, workers_, [] {}};
  std::shared_ptr<RecordingClient> client_ = std::make_shared<RecordingClient>();
};

TEST_F(LiveStreamTest, PosesAreThoseOfTheSnapshotInTheListsOrder) {
  Subscribe(1, "/gsv/poses");
  simulation_->Advance(seconds(3));
  Round();
  const auto data = client_->data(1);
  ASSERT_EQ(data.size(), 1u);
  EXPECT_EQ(data[0].time_ns, 3'000'000'000u);
  const auto poses = Decoded<Poses>(data[0]);
  EXPECT_EQ(poses.step, 300u);
  EXPECT_EQ(poses.layout_version, 1u);
  // The avatar and its wheels, robot_0 and its wheels.
  ASSERT_EQ(poses.poses.size(), 7u * 6);
  const double* robot = &poses.poses[7 * 3];
  EXPECT_NEAR(robot[0], std::cos(0.6), 1e-12);
  EXPECT_NEAR(robot[1], std::sin(0.6), 1e-12);
  const double yaw = 0.6 + std::numbers::pi / 2;
  EXPECT_NEAR(robot[5], std::sin(yaw / 2), 1e-12);
  EXPECT_NEAR(robot[6], std::cos(yaw / 2), 1e-12);
  // The left wheel stands 0.17 m to the left, which on this circle is towards the middle.
  EXPECT_NEAR(robot[7 + 0], 0.83 * std::cos(0.6), 1e-12);
  EXPECT_NEAR(robot[7 + 1], 0.83 * std::sin(0.6), 1e-12);
  EXPECT_NEAR(robot[7 + 2], 0.1, 1e-12);
}

TEST_F(LiveStreamTest, NothingIsSentThatDidNotChange) {
  Subscribe(1, "/gsv/poses");
  Subscribe(2, "/clock");
  Round();
  Round();
  Round();
  EXPECT_EQ(client_->data(1).size(), 1u);
  EXPECT_EQ(client_->data(2).size(), 1u);
  EXPECT_EQ(client_->times().size(), 1u);
  simulation_->Advance(milliseconds(10));
  Round();
  EXPECT_EQ(client_->data(1).size(), 2u);
  EXPECT_EQ(client_->times(), (std::vector<std::uint64_t>{0, 10'000'000}));
}

TEST_F(LiveStreamTest, PosesComeAtMostThirtyTimesASecond) {
  Subscribe(1, "/gsv/poses");
  for (int i = 0; i < 1000; ++i) {
    simulation_->Advance(milliseconds(1));
    Round(milliseconds(1));
  }
  EXPECT_GE(client_->data(1).size(), 29u);
  EXPECT_LE(client_->data(1).size(), 31u);
}

TEST_F(LiveStreamTest, ALateViewerOfAPausedSimulationGetsThePresentAtOnce) {
  Subscribe(1, "/gsv/poses");
  Subscribe(2, "/gsv/status");
  simulation_->Advance(seconds(1));
  Round();
  const auto late = std::make_shared<RecordingClient>();
  stream_.hub()->Add(late);
  Subscribe(*late, 1, "/gsv/poses");
  Subscribe(*late, 2, "/gsv/status");
  Round(milliseconds(1));
  ASSERT_EQ(late->data(1).size(), 1u);
  EXPECT_EQ(late->data(1)[0].payload, client_->data(1)[0].payload);
  EXPECT_EQ(late->data(2).size(), 1u);
  EXPECT_EQ(client_->data(1).size(), 1u);
  EXPECT_EQ(client_->data(2).size(), 1u);
}

TEST_F(LiveStreamTest, AChangeOfPhaseIsToldAtOnce) {
  Subscribe(1, "/gsv/status");
  Round();
  EXPECT_EQ(Decoded<SimulationStatus>(client_->data(1).at(0)).state, "created");
  ASSERT_TRUE(simulation_->Start());
  Round(milliseconds(1));
  const auto status = Decoded<SimulationStatus>(client_->data(1).at(1));
  EXPECT_EQ(status.state, "running");
  EXPECT_EQ(status.mode, "real_time");
  ASSERT_EQ(status.robots.size(), 2u);
  EXPECT_EQ(status.robots[1].name, "robot_0");
  EXPECT_EQ(status.robots[1].behaviour, "circle");
}

TEST_F(LiveStreamTest, StatusComesAtMostFiveTimesASecond) {
  Subscribe(1, "/gsv/status");
  for (int i = 0; i < 1000; ++i) {
    simulation_->Advance(milliseconds(1));
    Round(milliseconds(1));
  }
  EXPECT_GE(client_->data(1).size(), 5u);
  EXPECT_LE(client_->data(1).size(), 6u);
}

TEST_F(LiveStreamTest, EventsReachEverybodyOnceAndLateViewersFromTheBeginning) {
  simulation_->AddEvent("one");
  Subscribe(1, "/gsv/events");
  Round();
  simulation_->AddEvent("two");
  const auto late = std::make_shared<RecordingClient>();
  stream_.hub()->Add(late);
  Subscribe(*late, 1, "/gsv/events");
  Round();
  simulation_->AddEvent("three");
  Round();
  for (const auto& viewer : {client_, late}) {
    std::string seen;
    for (const auto& data : viewer->data(1)) seen += Decoded<LifecycleEvent>(data).event + " ";
    EXPECT_EQ(seen, "one two three ");
  }
}

TEST_F(LiveStreamTest, TransformsAreAgainstTheWorldAndTheRobot) {
  simulation_->Advance(seconds(2));
  Subscribe(1, "/tf");
  Round();
  const auto transforms = Decoded<TFMessage>(client_->data(1).at(0)).transforms;
  ASSERT_EQ(transforms.size(), 6u);
  EXPECT_EQ(transforms[3].header.frame_id, "world");
  EXPECT_EQ(transforms[3].child_frame_id, "robot_0");
  EXPECT_NEAR(transforms[3].transform.translation.x, std::cos(0.4), 1e-12);
  EXPECT_EQ(transforms[4].header.frame_id, "robot_0");
  EXPECT_EQ(transforms[4].child_frame_id, "robot_0/left_wheel");
  EXPECT_NEAR(transforms[4].transform.translation.x, 0, 1e-12);
  EXPECT_NEAR(transforms[4].transform.translation.y, 0.17, 1e-12);
  // Turned by 2 rad about its axle, y.
  EXPECT_NEAR(transforms[4].transform.rotation.y, std::sin(1.0), 1e-12);
  EXPECT_NEAR(transforms[4].transform.rotation.w, std::cos(1.0), 1e-12);
}

TEST_F(LiveStreamTest, AReadingIsTakenOnlyForThoseWhoWatchAndOnlyWhenTimeHasPassed) {
  std::atomic<int> readings{0};
  simulation_->set_on_watch([&](const std::string&) -> base::Status {
    ++readings;
    return {};
  });
  Round();
  EXPECT_EQ(readings, 0);
  Subscribe(1, "/robot_0/front_sonar");
  const auto range = Decoded<messages::sensor_msgs::Range>(RoundUntil(1, 1));
  EXPECT_EQ(range.header.frame_id, "robot_0/front_sonar");
  // From (1, 0) northwards there is nothing for 5 m.
  EXPECT_FLOAT_EQ(range.range, 5);
  Round(seconds(1));
  simulation_->Advance(milliseconds(10));
  RoundUntil(1, 2);
  workers_.Stop();
  EXPECT_EQ(readings, 2);
}

TEST_F(LiveStreamTest, PicturesComeAtMostFiveTimesASecond) {
  Round();
  Subscribe(1, "/robot_0/camera");
  for (std::size_t fifth = 1; fifth <= 5; ++fifth) {
    for (int i = 0; i < 20; ++i) {
      simulation_->Advance(milliseconds(10));
      Round(milliseconds(10));
    }
    // A reading that was due while the one before was taken is asked for in a later round.
    while (client_->data(1).size() < fifth) Round(milliseconds(0));
  }
  workers_.Stop();
  EXPECT_LE(client_->data(1).size(), 6u);
}

TEST_F(LiveStreamTest, WhatGoesWithPicturesComesWithoutThemAndWithEach) {
  std::atomic<int> readings{0};
  simulation_->set_on_watch([&](const std::string&) -> base::Status {
    ++readings;
    return {};
  });
  Round();
  Subscribe(1, "/robot_0/camera/camera_info");
  const auto info = Decoded<messages::sensor_msgs::CameraInfo>(RoundUntil(1, 1));
  EXPECT_EQ(info.header.frame_id, "robot_0/camera");
  EXPECT_EQ(readings, 0);  // no picture is taken for that
  Subscribe(2, "/robot_0/camera");
  const auto picture = Decoded<messages::sensor_msgs::CompressedImage>(RoundUntil(2, 1));
  const auto beside = Decoded<messages::sensor_msgs::CameraInfo>(RoundUntil(1, 2));
  EXPECT_EQ(beside.header.stamp.nanosec, picture.header.stamp.nanosec);
  workers_.Stop();
}

TEST_F(LiveStreamTest, BeamsAreLinesFromTheSensorAsLongAsTheReading) {
  Subscribe(1, "/gsv/beams");
  const auto markers = Decoded<MarkerArray>(RoundUntil(1, 1)).markers;
  ASSERT_EQ(markers.size(), 2u);
  const auto& robot = markers[1];
  EXPECT_EQ(robot.ns, "robot_0");
  EXPECT_EQ(robot.type, messages::visualization_msgs::Marker::kLineList);
  EXPECT_EQ(robot.header.frame_id, "world");
  // Ahead, from (1, 0.25) five metres north; to the left, from (1, 0) west to the avatar's wheel
  // or body, whose nearest surface is 0.25 m from the origin.
  bool found_front = false, found_left = false;
  for (std::size_t i = 0; i + 1 < robot.points.size(); i += 2) {
    const auto &from = robot.points[i], &to = robot.points[i + 1];
    if (std::abs(from.y - 0.25) < 1e-9 && std::abs(to.y - 5.25) < 1e-9) found_front = true;
    if (std::abs(from.x - 1) < 1e-9 && std::abs(from.y) < 1e-9 && std::abs(to.x - 0.25) < 1e-9 &&
        std::abs(from.z - 0.2) < 1e-9) {
      found_left = true;
    }
  }
  EXPECT_TRUE(found_front);
  EXPECT_TRUE(found_left);
}

TEST_F(LiveStreamTest, ASensorThatFailsIsReportedOnce) {
  simulation_->set_on_watch(
      [](const std::string&) { return base::Fail(base::ErrorCode::kUnavailable, "no renderer"); });
  Round();
  Subscribe(1, "/robot_0/camera");
  while (Complaints("no renderer") == 0) {
    Round(milliseconds(1));
    std::this_thread::yield();
  }
  for (int i = 0; i < 3; ++i) {
    simulation_->Advance(seconds(1));
    Round(seconds(1));
  }
  workers_.Stop();
  EXPECT_EQ(Complaints("no renderer"), 1u);
}

TEST_F(LiveStreamTest, TopicsFollowTheRobotsAndTheirSensors) {
  Round();
  EXPECT_EQ(client_->ChannelOf("/robot_1/front_sonar"), 0u);
  simulation_->AddOneRobot();
  Round();
  EXPECT_NE(client_->ChannelOf("/robot_1/front_sonar"), 0u);

  model::SensorDescription rear;
  rear.name = "rear";
  rear.type = "sonar";
  simulation_->Mount("robot_0", rear);
  Round(seconds(2));
  EXPECT_NE(client_->ChannelOf("/robot_0/rear"), 0u);

  Subscribe(1, "/gsv/poses");
  Round();
  EXPECT_EQ(Decoded<Poses>(client_->data(1).at(0)).layout_version, 2u);
  EXPECT_EQ(Decoded<Poses>(client_->data(1).at(0)).poses.size(), 7u * 9);
}

TEST_F(LiveStreamTest, CommandsAreToldWhenTheyChangeAndToNewcomers) {
  simulation_->AddOneRobot();
  Subscribe(1, "/gsv/commands");
  Round();
  EXPECT_TRUE(client_->data(1).empty());  // nobody was told anything
  simulation_->Advance(seconds(1));
  simulation_->Tell("robot_1", {0.5, 0, 0.25}, milliseconds(990));
  Round();
  Round();
  ASSERT_EQ(client_->data(1).size(), 1u);
  const auto command = Decoded<messages::gsv_msgs::Command>(client_->data(1)[0]);
  EXPECT_EQ(command.robot, "robot_1");
  EXPECT_EQ(command.linear_m_s, 0.5);
  EXPECT_EQ(command.angular_rad_s, 0.25);
  EXPECT_EQ(messages::ToSimTime(command.stamp), milliseconds(990));
  EXPECT_EQ(command.step, 99u);
  auto late = std::make_shared<RecordingClient>();
  stream_.hub()->Add(late);
  Subscribe(*late, 1, "/gsv/commands");
  Round();
  EXPECT_EQ(late->data(1).size(), 1u);
}

TEST_F(LiveStreamTest, ACrowdsCommandsAreSpreadOverRounds) {
  for (int i = 1; i < 100; ++i) simulation_->AddOneRobot();
  simulation_->Advance(seconds(1));
  for (int i = 0; i < 100; ++i) {
    simulation_->Tell("robot_" + std::to_string(i), {1, 0, 0}, milliseconds(10));
  }
  Subscribe(1, "/gsv/commands");
  Round();
  EXPECT_EQ(client_->data(1).size(), 64u);
  Round();
  ASSERT_EQ(client_->data(1).size(), 100u);
  std::set<std::string> robots;
  for (const ReceivedData& data : client_->data(1)) {
    robots.insert(Decoded<messages::gsv_msgs::Command>(data).robot);
  }
  EXPECT_EQ(robots.size(), 100u);
}

TEST_F(LiveStreamTest, StaticTransformsPlaceTheSensors) {
  Round();
  Subscribe(1, "/tf_static");
  Round();
  Round();
  ASSERT_EQ(client_->data(1).size(), 1u);
  for (const auto& transform : Decoded<TFMessage>(client_->data(1)[0]).transforms) {
    if (transform.child_frame_id != "robot_0/left_sonar") continue;
    EXPECT_EQ(transform.header.frame_id, "robot_0");
    EXPECT_NEAR(transform.transform.rotation.z, std::sqrt(0.5), 1e-12);
    return;
  }
  FAIL() << "no transform of robot_0/left_sonar";
}

}  // namespace
}  // namespace gsv::gateway
