#include "gsv/ros2/joint_trajectory.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gsv/messages/cdr.h"
#include "gsv/messages/trajectory_msgs.h"

namespace gsv::ros2 {
namespace {

using messages::trajectory_msgs::JointTrajectoryPoint;
using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using namespace std::chrono_literals;

model::Model ModelOfTwoJoints() {
  model::Model model;
  model.joints.resize(3);
  model.joints[0].name = "wheel";
  model.joints[1].name = "shoulder";
  model.joints[2].name = "elbow";
  return model;
}

JointTrajectoryPoint PointAt(std::int32_t sec, std::vector<double> positions,
                             std::vector<double> velocities = {}) {
  JointTrajectoryPoint point;
  point.time_from_start.sec = sec;
  point.positions = std::move(positions);
  point.velocities = std::move(velocities);
  return point;
}

base::Result<JointTrajectory> ReadTrajectory(std::vector<std::string> names,
                                             std::vector<JointTrajectoryPoint> points,
                                             std::int32_t stamp = 0) {
  messages::trajectory_msgs::JointTrajectory message;
  message.header.stamp.sec = stamp;
  message.joint_names = std::move(names);
  message.points = std::move(points);
  messages::Bytes bytes;
  messages::Encode(message, bytes);
  return ReadJointTrajectory(bytes, ModelOfTwoJoints(), {1, 2});
}

std::string WhyNot(std::vector<std::string> names, std::vector<JointTrajectoryPoint> points) {
  const auto read = ReadTrajectory(std::move(names), std::move(points));
  return read ? "" : read.error().message;
}

TEST(JointTrajectory, IsLinearWithoutVelocities) {
  const auto read =
      ReadTrajectory({"elbow", "shoulder"}, {PointAt(2, {1, -2}), PointAt(4, {3, 0})});
  ASSERT_TRUE(read) << read.error().Sentence();
  EXPECT_EQ(read->start, std::nullopt);
  EXPECT_THAT(read->joints, ElementsAre(2, 1));
  EXPECT_THAT(read->PositionsAt(0s, {0, 0}), ElementsAre(0, 0));
  EXPECT_THAT(read->PositionsAt(1s, {0, 0}), ElementsAre(0.5, -1));
  EXPECT_THAT(read->PositionsAt(2s, {0, 0}), ElementsAre(1, -2));
  EXPECT_THAT(read->PositionsAt(3s, {0, 0}), ElementsAre(2, -1));
  EXPECT_THAT(read->PositionsAt(9s, {0, 0}), ElementsAre(3, 0));
}

// From rest to rest, the path is 3 s² - 2 s³ with s = time / duration. At s = 0.25, this is
// 0.15625.
TEST(JointTrajectory, IsCubicWithVelocities) {
  const auto read = ReadTrajectory({"elbow"}, {PointAt(2, {1}, {0}), PointAt(4, {1}, {1})}, 7);
  ASSERT_TRUE(read) << read.error().Sentence();
  EXPECT_EQ(read->start, base::SimTime(7s));
  EXPECT_THAT(read->PositionsAt(500ms, {0}), ElementsAre(DoubleNear(0.15625, 1e-15)));
  EXPECT_THAT(read->PositionsAt(1s, {0}), ElementsAre(DoubleNear(0.5, 1e-15)));
  // The cubic from (position 0, slope 0) to (0, slope 1) over 2 s is 2 (s³ - s²). At s = 0.5, this
  // is -0.25.
  EXPECT_THAT(read->PositionsAt(3s, {0}), ElementsAre(DoubleNear(0.75, 1e-15)));
}

TEST(JointTrajectory, WithoutPointsStopsTheJoints) {
  const auto read = ReadTrajectory({"elbow"}, {});
  ASSERT_TRUE(read) << read.error().Sentence();
  EXPECT_THAT(read->PositionsAt(5s, {0.3}), ElementsAre(0.3));
}

TEST(JointTrajectory, RejectsInvalidMessagesWithAReason) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(WhyNot({}, {}), "it names no joints");
  EXPECT_THAT(WhyNot({"wheel"}, {}), HasSubstr("no joint 'wheel' that takes commands"));
  EXPECT_THAT(WhyNot({"elbow", "elbow"}, {}), HasSubstr("named twice"));
  EXPECT_THAT(WhyNot({"elbow"}, {PointAt(1, {1, 2})}), HasSubstr("needs 1 positions"));
  EXPECT_THAT(WhyNot({"elbow"}, {PointAt(1, {1}, {1, 2})}), HasSubstr("1 velocities or none"));
  EXPECT_THAT(WhyNot({"elbow"}, {PointAt(1, {nan})}), HasSubstr("must be finite"));
  EXPECT_THAT(WhyNot({"elbow"}, {PointAt(-1, {1})}), HasSubstr("must increase"));
  EXPECT_THAT(WhyNot({"elbow"}, {PointAt(1, {1}), PointAt(1, {2})}), HasSubstr("must increase"));
}

TEST(JointTrajectory, RejectsTruncatedMessages) {
  messages::trajectory_msgs::JointTrajectory message;
  message.joint_names = {"elbow"};
  message.points = {PointAt(1, {1}, {0})};
  messages::Bytes bytes;
  messages::Encode(message, bytes);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_FALSE(ReadJointTrajectory(std::span(bytes).first(size), ModelOfTwoJoints(), {1, 2}));
  }
}

}  // namespace
}  // namespace gsv::ros2
