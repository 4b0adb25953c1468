#include "gsv/gateway/live/sensor_topics.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <thread>

#include <gtest/gtest.h>

#include "gsv/gateway/testing/live_stream_fixture.h"
#include "gsv/messages/sensor_msgs.h"
#include "gsv/messages/tf2_msgs.h"
#include "gsv/messages/visualization_msgs.h"

namespace gsv::gateway {
namespace {

using messages::tf2_msgs::TFMessage;
using messages::visualization_msgs::MarkerArray;
using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::Decoded;
using testing::LiveStreamTest;

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

TEST_F(LiveStreamTest, TwoThousandSensorsHaveATopicAndTheOthersAreTold) {
  model::SensorDescription sonar = simulation_->sensors("robot_0").front();
  const std::string complaint =
      "there are more sensors than can be listed: the first 2000 have a topic of their own";
  const auto topics = [&] {
    std::ptrdiff_t count = 0;
    for (const auto& text : client_->texts()) {
      if (text.value("op", "") != "advertise") continue;
      count +=
          std::count_if(text["channels"].begin(), text["channels"].end(), [](const auto& channel) {
            return channel["topic"].template get<std::string>().starts_with("/robot_0/many_");
          });
    }
    return count;
  };
  const auto mount = [&](int from, int to) {
    for (int i = from; i < to; ++i) {
      sonar.name = "many_" + std::to_string(i);
      simulation_->Mount("robot_0", sonar);
    }
    Round(seconds(2));
  };
  mount(0, 1000);
  EXPECT_EQ(topics(), 1000);
  EXPECT_EQ(Complaints(complaint), 0u);
  mount(1000, 2000);  // those that it has besides make it more
  EXPECT_LT(topics(), 2000);
  EXPECT_GT(topics(), 1980);
  EXPECT_EQ(Complaints(complaint), 1u);
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
  EXPECT_EQ(robot.header.frame_id, "map");
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
