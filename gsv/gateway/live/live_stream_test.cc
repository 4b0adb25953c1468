#include "gsv/gateway/live/live_stream.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "gsv/gateway/testing/live_stream_fixture.h"
#include "gsv/messages/diagnostic_msgs.h"
#include "gsv/messages/gsv_msgs.h"
#include "gsv/messages/rcl_interfaces.h"
#include "gsv/messages/tf2_msgs.h"
#include "gsv/presentation/topics.h"

namespace gsv::gateway {
namespace {

using messages::gsv_msgs::LifecycleEvent;
using messages::gsv_msgs::Poses;
using messages::gsv_msgs::SimulationStatus;
using messages::tf2_msgs::TFMessage;
using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::Decoded;
using testing::LiveStreamTest;
using testing::RecordingClient;

TEST_F(LiveStreamTest, AdvertisesTheLiveTopicsOfTheTopicTable) {
  for (const presentation::Topic& topic : presentation::Topics()) {
    // /gsv/viewers is not advertised, because this stream has no ViewerRegistry.
    const bool is_there = topic.is_live && topic.name != presentation::topics::kViewers.name;
    EXPECT_EQ(client_->ChannelOf(std::string(topic.name)) != 0, is_there) << topic.name;
  }
}

TEST_F(LiveStreamTest, SendsPosesInTheOrderOfTheSnapshotsBodies) {
  Subscribe(1, "/gsv/poses");
  simulation_->Advance(seconds(3));
  Round();
  const auto data = client_->data(1);
  ASSERT_EQ(data.size(), 1u);
  EXPECT_EQ(data[0].time_ns, 3'000'000'000u);
  const auto poses = Decoded<Poses>(data[0]);
  EXPECT_EQ(poses.step, 300u);
  EXPECT_EQ(poses.layout_version, 1u);
  // The six poses belong to the avatar, robot_0, and the two wheels of each of them.
  ASSERT_EQ(poses.poses.size(), 7u * 6);
  const double* robot = &poses.poses[7 * 3];
  EXPECT_NEAR(robot[0], std::cos(0.6), 1e-12);
  EXPECT_NEAR(robot[1], std::sin(0.6), 1e-12);
  const double yaw = 0.6 + std::numbers::pi / 2;
  EXPECT_NEAR(robot[5], std::sin(yaw / 2), 1e-12);
  EXPECT_NEAR(robot[6], std::cos(yaw / 2), 1e-12);
  // The left wheel is 0.17 m to the left, which on this circle is towards the middle.
  EXPECT_NEAR(robot[7 + 0], 0.83 * std::cos(0.6), 1e-12);
  EXPECT_NEAR(robot[7 + 1], 0.83 * std::sin(0.6), 1e-12);
  EXPECT_NEAR(robot[7 + 2], 0.1, 1e-12);
}

TEST_F(LiveStreamTest, UnchangedDataIsNotSent) {
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

TEST_F(LiveStreamTest, PosesAreSentAtMostThirtyTimesPerSecond) {
  Subscribe(1, "/gsv/poses");
  for (int i = 0; i < 1000; ++i) {
    simulation_->Advance(milliseconds(1));
    Round(milliseconds(1));
  }
  EXPECT_GE(client_->data(1).size(), 29u);
  EXPECT_LE(client_->data(1).size(), 31u);
}

TEST_F(LiveStreamTest, ALateViewerOfAPausedSimulationGetsTheStateAtOnce) {
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

TEST_F(LiveStreamTest, AChangeOfPhaseIsSentAtOnce) {
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

TEST_F(LiveStreamTest, StatusIsSentAtMostFiveTimesPerSecond) {
  Subscribe(1, "/gsv/status");
  for (int i = 0; i < 1000; ++i) {
    simulation_->Advance(milliseconds(1));
    Round(milliseconds(1));
  }
  EXPECT_GE(client_->data(1).size(), 5u);
  EXPECT_LE(client_->data(1).size(), 6u);
}

TEST_F(LiveStreamTest, ALargeStatusIsSentLessOftenWhileOnlyCountersChange) {
  const auto crowd = std::make_shared<testing::ScriptedSimulation>("crowd", 500);
  LiveStream stream(crowd, workers_, workers_, nullptr, [] {});
  const auto viewer = std::make_shared<RecordingClient>();
  stream.hub()->Add(viewer);
  ASSERT_TRUE(stream.hub()->Receive(viewer.get(),
                                    testing::SubscribeText(1, viewer->ChannelOf("/gsv/status"))));
  const auto round = [&] {
    now_ += milliseconds(100);
    crowd->Advance(milliseconds(100));
    stream.Round(crowd, now_);
  };
  constexpr int kSeconds = 10;
  for (int i = 0; i < 10 * kSeconds; ++i) round();
  const std::size_t count = viewer->data(1).size();
  const auto size = static_cast<double>(viewer->data(1)[0].payload.size());
  EXPECT_GT(size * kStatusRate, kMaxStatusBytesPerSecond);  // the status must exceed the limit, or
                                                            // this test shows nothing
  EXPECT_GE(static_cast<double>(count), kMinStatusRate * kSeconds);
  EXPECT_LE(static_cast<double>(count - 1) * size, kMaxStatusBytesPerSecond * kSeconds * 1.1);
  // A change of a state is published at once, even if the status is large.
  ASSERT_TRUE(crowd->Start());
  round();
  EXPECT_EQ(viewer->data(1).size(), count + 1);
}

TEST_F(LiveStreamTest, ANoteIsPublishedOnItsOwnTopic) {
  Subscribe(1, "/gsv/events");
  Subscribe(2, "/gsv/notes");
  Round();
  simulation_->Emit("note", "", "at 0.5 s: look here");
  simulation_->AddEvent("one");
  Round();
  ASSERT_EQ(client_->data(1).size(), 1u);
  EXPECT_EQ(Decoded<LifecycleEvent>(client_->data(1)[0]).event, "one");
  ASSERT_EQ(client_->data(2).size(), 1u);
  EXPECT_EQ(Decoded<LifecycleEvent>(client_->data(2)[0]).detail, "look here");
  EXPECT_EQ(Decoded<LifecycleEvent>(client_->data(2)[0]).stamp.nanosec, 500'000'000u);
  const auto late = std::make_shared<RecordingClient>();
  stream_.hub()->Add(late);
  Subscribe(*late, 1, "/gsv/notes");
  Round();
  EXPECT_EQ(late->data(1).size(), 1u);
}

TEST_F(LiveStreamTest, EventsReachEachViewerOnceAndLateViewersFromTheBeginning) {
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

TEST_F(LiveStreamTest, PublishesEventsAsALogForRosTools) {
  simulation_->AddEvent("one");
  Subscribe(1, "/rosout");
  Round();
  simulation_->AddEvent("two_three");
  Round();
  ASSERT_EQ(client_->data(1).size(), 2u);
  EXPECT_EQ(Decoded<messages::rcl_interfaces::Log>(client_->data(1)[0]).msg, "one");
  EXPECT_EQ(Decoded<messages::rcl_interfaces::Log>(client_->data(1)[1]).msg, "two three");
}

TEST_F(LiveStreamTest, DiagnosticsAreSentOncePerSecondAndWithAChangeOfPhase) {
  Subscribe(1, "/diagnostics");
  for (int i = 0; i < 300; ++i) {
    simulation_->Advance(milliseconds(10));
    Round(milliseconds(10));
  }
  const std::size_t before = client_->data(1).size();
  EXPECT_GE(before, 3u);
  EXPECT_LE(before, 4u);
  ASSERT_TRUE(simulation_->Start());
  Round(milliseconds(1));
  ASSERT_EQ(client_->data(1).size(), before + 1);
  const auto diagnostics =
      Decoded<messages::diagnostic_msgs::DiagnosticArray>(client_->data(1).back());
  ASSERT_EQ(diagnostics.status.size(), 3u);  // the simulation and two robots
  EXPECT_EQ(diagnostics.status[0].message, "running");
}

TEST_F(LiveStreamTest, TransformsAreRelativeToTheWorldOrTheRobot) {
  simulation_->Advance(seconds(2));
  Subscribe(1, "/tf");
  Round();
  const auto transforms = Decoded<TFMessage>(client_->data(1).at(0)).transforms;
  ASSERT_EQ(transforms.size(), 6u);
  EXPECT_EQ(transforms[3].header.frame_id, "map");
  EXPECT_EQ(transforms[3].child_frame_id, "robot_0/base_link");
  EXPECT_NEAR(transforms[3].transform.translation.x, std::cos(0.4), 1e-12);
  EXPECT_EQ(transforms[4].header.frame_id, "robot_0/base_link");
  EXPECT_EQ(transforms[4].child_frame_id, "robot_0/left_wheel");
  EXPECT_NEAR(transforms[4].transform.translation.x, 0, 1e-12);
  EXPECT_NEAR(transforms[4].transform.translation.y, 0.17, 1e-12);
  // The wheel is rotated by 2 rad about its axle, y.
  EXPECT_NEAR(transforms[4].transform.rotation.y, std::sin(1.0), 1e-12);
  EXPECT_NEAR(transforms[4].transform.rotation.w, std::cos(1.0), 1e-12);
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

}  // namespace
}  // namespace gsv::gateway
