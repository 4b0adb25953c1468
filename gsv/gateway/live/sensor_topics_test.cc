#include "gsv/gateway/live/sensor_topics.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include "gsv/gateway/testing/live_stream_fixture.h"
#include "gsv/messages/sensor_msgs.h"
#include "gsv/messages/tf2_msgs.h"
#include "gsv/messages/visualization_msgs.h"
#include "gsv/presentation/sensor_messages.h"

namespace gsv::gateway {
namespace {

using messages::tf2_msgs::TFMessage;
using messages::visualization_msgs::MarkerArray;
using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::Decoded;
using testing::LiveStreamTest;

TEST_F(LiveStreamTest, ReadsSensorsOnlyForSubscribersAndOnlyIfTimeHasPassed) {
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
  // There is no obstacle for 5 m to the north of (1, 0).
  EXPECT_FLOAT_EQ(range.range, 5);
  Round(seconds(1));
  simulation_->Advance(milliseconds(10));
  RoundUntil(1, 2);
  workers_.Stop();
  EXPECT_EQ(readings, 2);
}

TEST_F(LiveStreamTest, ARequestedRobotHasItsOwnBeamsTopic) {
  simulation_->AddOneRobot();
  Round();
  EXPECT_EQ(client_->ChannelOf("/gsv/beams/robot_1"), 0u);
  stream_.WantSensorsOf("robot_1");
  Round();
  Subscribe(1, "/gsv/beams");
  Subscribe(2, "/gsv/beams/robot_1");
  const auto all = Decoded<MarkerArray>(RoundUntil(1, 1));
  const auto its = Decoded<MarkerArray>(RoundUntil(2, 1));
  ASSERT_EQ(its.markers.size(), 1u);
  const auto same = std::find_if(all.markers.begin(), all.markers.end(),
                                 [](const auto& marker) { return marker.ns == "robot_1"; });
  ASSERT_NE(same, all.markers.end());
  EXPECT_GE(its.markers[0].points.size(), 2u);
  EXPECT_EQ(its.markers[0], *same);
}

class ManySensorsTest : public LiveStreamTest {
 protected:
  void Mount(const std::string& robot, int from, int to) {
    model::SensorDescription sonar = simulation_->sensors("robot_0").front();
    for (int i = from; i < to; ++i) {
      sonar.name = "many_" + std::to_string(i);
      simulation_->Mount(robot, sonar);
    }
    Round(seconds(2));
  }

  // Returns the present number of sensor topics, by robot.
  std::map<std::string, std::size_t> TopicsByRobot() const {
    std::map<std::uint64_t, std::string> robots;  // by channel
    for (const auto& text : client_->texts()) {
      if (text.value("op", "") == "unadvertise") {
        for (const auto& id : text["channelIds"]) robots.erase(id.get<std::uint64_t>());
      }
      if (text.value("op", "") != "advertise") continue;
      for (const auto& channel : text["channels"]) {
        const auto topic = channel["topic"].get<std::string>();
        const std::size_t end = topic.find("/many_");
        if (end == std::string::npos) continue;
        robots[channel["id"].get<std::uint64_t>()] = topic.substr(1, end - 1);
      }
    }
    std::map<std::string, std::size_t> counts;
    for (const auto& [id, robot] : robots) ++counts[robot];
    return counts;
  }
  std::size_t Topics(const std::string& robot) const { return TopicsByRobot()[robot]; }

  // Requests the sensors of the robot, as the API does if a viewer has selected it.
  void Want(const std::string& robot) {
    stream_.WantSensorsOf(robot);
    Round();
  }

  const std::string complaint_ =
      "there are more sensors than topics: the first 2000 have a topic of their own, the "
      "others get one when a viewer selects their robot (docs/formats/live.md)";
};

TEST_F(ManySensorsTest, AdvertisesTwoThousandSensorsAndReportsThatThereAreMore) {
  Mount("robot_0", 0, 1000);
  EXPECT_EQ(Topics("robot_0"), 1000u);
  EXPECT_EQ(WarningCount(complaint_), 0u);
  Mount("robot_0", 1000, 2000);  // adds sensors to the robot's existing sensors
  EXPECT_LT(Topics("robot_0"), 2000u);
  EXPECT_GT(Topics("robot_0"), 1980u);
  EXPECT_EQ(WarningCount(complaint_), 1u);
}

TEST_F(ManySensorsTest, FurtherSensorsGetATopicWhenTheirRobotIsRequested) {
  simulation_->AddOneRobot();
  Mount("robot_0", 0, 2000);
  Mount("robot_1", 0, 3);
  EXPECT_EQ(Topics("robot_1"), 0u);
  Want("robot_1");
  EXPECT_EQ(Topics("robot_1"), 3u);
  Subscribe(1, "/robot_1/many_2");
  EXPECT_EQ(Decoded<messages::sensor_msgs::Range>(RoundUntil(1, 1)).header.frame_id,
            "robot_1/many_2");
  Mount("robot_1", 3, 5);  // sensors that are mounted later are listed as well
  EXPECT_EQ(Topics("robot_1"), 5u);
  Want("nobody");
  workers_.Stop();
}

TEST_F(ManySensorsTest, TheFirstRequestedRobotIsRemovedFirstUnlessSubscribed) {
  const int count = static_cast<int>(kMaxWantedRobots) + 2;
  for (int i = 1; i <= count; ++i) simulation_->AddOneRobot();
  Mount("robot_0", 0, 2000);
  const auto name = [](int i) { return "robot_" + std::to_string(i); };
  for (int i = 1; i <= count; ++i) Mount(name(i), 0, 1);
  Want(name(1));
  Subscribe(1, "/robot_1/many_0");
  for (int i = 2; i <= count; ++i) Want(name(i));
  std::map<std::string, std::size_t> expected;
  for (int i = 1; i <= count; ++i) expected[name(i)] = 1;
  expected.erase(name(2));
  expected.erase(name(3));
  const auto of_the_wanted = [&] {
    auto counts = TopicsByRobot();
    counts.erase("robot_0");
    return counts;
  };
  EXPECT_EQ(of_the_wanted(), expected);
  Want(name(2));
  expected[name(2)] = 1;
  expected.erase(name(4));
  EXPECT_EQ(of_the_wanted(), expected);
  workers_.Stop();
}

TEST_F(LiveStreamTest, ImagesAreSentAtMostFiveTimesPerSecond) {
  Round();
  Subscribe(1, "/robot_0/camera");
  const WallTime asked = now_;
  for (std::size_t fifth = 1; fifth <= 5; ++fifth) {
    for (int i = 0; i < 20; ++i) {
      simulation_->Advance(milliseconds(10));
      Round(milliseconds(10));
    }
    // If a reading becomes due during the previous reading, a later call of Round() starts it. So
    // the test calls Round() until the image has arrived.
    RoundUntil(1, fifth);
  }
  workers_.Stop();
  const auto fifths = static_cast<std::size_t>((now_ - asked) / milliseconds(200));
  EXPECT_LE(client_->data(1).size(), fifths + 1);
}

TEST_F(LiveStreamTest, ReadsASlowSensorLessOften) {
  constexpr auto kLong = milliseconds(20);
  std::atomic<int> readings{0};
  simulation_->set_on_watch([&](const std::string&) -> base::Status {
    const auto end = std::chrono::steady_clock::now() + kLong;
    while (std::chrono::steady_clock::now() < end) std::this_thread::yield();
    ++readings;
    return {};
  });
  Round();
  Subscribe(1, "/robot_0/front_sonar");
  const WallTime asked = now_;
  RoundUntil(1, 1);
  simulation_->Advance(milliseconds(10));
  // A reading is due by the sensor's rate, but readings may use only a tenth of the processor time.
  now_ = asked;
  Round(9 * kLong);
  simulation_->Advance(milliseconds(10));
  Round(seconds(10));
  RoundUntil(1, 2);
  workers_.Stop();
  EXPECT_EQ(readings, 2);
}

TEST_F(LiveStreamTest, SendsCameraInfoAtOnceAndWithEachImage) {
  std::atomic<int> readings{0};
  simulation_->set_on_watch([&](const std::string&) -> base::Status {
    ++readings;
    return {};
  });
  Round();
  Subscribe(1, "/robot_0/camera/camera_info");
  const auto info = Decoded<messages::sensor_msgs::CameraInfo>(RoundUntil(1, 1));
  EXPECT_EQ(info.header.frame_id, "robot_0/camera");
  EXPECT_EQ(readings, 0);  // no image is rendered for the camera_info
  Subscribe(2, "/robot_0/camera");
  const auto image = Decoded<messages::sensor_msgs::CompressedImage>(RoundUntil(2, 1));
  const auto beside = Decoded<messages::sensor_msgs::CameraInfo>(RoundUntil(1, 2));
  EXPECT_EQ(beside.header.stamp.nanosec, image.header.stamp.nanosec);
  workers_.Stop();
}

TEST_F(LiveStreamTest, BeamsAreLinesFromTheSensorAsLongAsTheReading) {
  Subscribe(1, "/gsv/beams");
  const auto markers = Decoded<MarkerArray>(RoundUntil(1, 1)).markers;
  ASSERT_EQ(markers.size(), 2u);
  const auto& robot = markers[1];
  EXPECT_EQ(robot.ns, "robot_0");
  EXPECT_EQ(robot.type, messages::visualization_msgs::Marker::kLineList);
  EXPECT_EQ(robot.header.frame_id, "map");
  // Ahead, the wall is five metres north of (1, 0.25). To the left, west of (1, 0), is the avatar's
  // wheel or body, whose nearest surface is 0.25 m from the origin.
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

TEST_F(LiveStreamTest, DeletionsOfBeamsAreRepeatedForViewersThatMissMessages) {
  Subscribe(1, "/gsv/beams");
  ASSERT_EQ(Decoded<MarkerArray>(RoundUntil(1, 1)).markers.size(), 2u);
  simulation_->set_on_watch(
      [](const std::string&) { return base::Fail(base::ErrorCode::kUnavailable, "no beams"); });
  const std::size_t last = 1 + presentation::BeamMarkers::kDeletions;
  for (std::size_t count = 2; count <= last + 1; ++count) {
    simulation_->Advance(seconds(1));
    const auto markers = Decoded<MarkerArray>(RoundUntil(1, count)).markers;
    ASSERT_EQ(markers.size(), count <= last ? 2u : 0u) << count;
    for (const auto& marker : markers) {
      EXPECT_EQ(marker.action, messages::visualization_msgs::Marker::kDelete);
    }
  }
  workers_.Stop();
}

TEST_F(LiveStreamTest, ASensorThatFailsIsReportedOnce) {
  simulation_->set_on_watch(
      [](const std::string&) { return base::Fail(base::ErrorCode::kUnavailable, "no renderer"); });
  Round();
  Subscribe(1, "/robot_0/camera");
  while (WarningCount("no renderer") == 0) {
    Round(milliseconds(1));
    std::this_thread::yield();
  }
  for (int i = 0; i < 3; ++i) {
    simulation_->Advance(seconds(1));
    Round(seconds(1));
  }
  workers_.Stop();
  EXPECT_EQ(WarningCount("no renderer"), 1u);
}

TEST_F(LiveStreamTest, StaticTransformsPlaceTheSensors) {
  Round();
  Subscribe(1, "/tf_static");
  Round();
  Round();
  ASSERT_EQ(client_->data(1).size(), 1u);
  for (const auto& transform : Decoded<TFMessage>(client_->data(1)[0]).transforms) {
    if (transform.child_frame_id != "robot_0/left_sonar") continue;
    EXPECT_EQ(transform.header.frame_id, "robot_0/base_link");
    EXPECT_NEAR(transform.transform.rotation.z, std::sqrt(0.5), 1e-12);
    return;
  }
  FAIL() << "no transform of robot_0/left_sonar";
}

}  // namespace
}  // namespace gsv::gateway
