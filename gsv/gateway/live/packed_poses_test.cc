#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "gsv/gateway/testing/live_stream_fixture.h"
#include "gsv/messages/gsv_msgs.h"

namespace gsv::gateway {
namespace {

using messages::gsv_msgs::PackedPoses;
using messages::gsv_msgs::Poses;
using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::Decoded;
using testing::LiveStreamTest;

using Rotation = std::array<double, 4>;  // the four numbers x y z w

// Unpacks a rotation as the comments of the message's definition describe it.
Rotation Unpacked(const std::uint16_t* numbers) {
  const int missing = 2 * (numbers[0] >> 15) + (numbers[1] >> 15);
  Rotation rotation{};
  double squared = 0;
  for (int i = 0, next = 0; i < 4; ++i) {
    if (i == missing) continue;
    rotation[i] = ((numbers[next++] & 0x7fff) / 16383.5 - 1) / std::numbers::sqrt2;
    squared += rotation[i] * rotation[i];
  }
  rotation[missing] = std::sqrt(std::max(0.0, 1 - squared));
  return rotation;
}

double AngleBetween(const Rotation& a, const double* b) {
  double dot = 0;
  for (int i = 0; i < 4; ++i) dot += a[i] * b[i];
  return 2 * std::acos(std::min(1.0, std::abs(dot)));
}

TEST_F(LiveStreamTest, PackedPosesEqualThePosesUpToRounding) {
  Subscribe(1, "/gsv/poses");
  Subscribe(2, "/gsv/packed_poses");
  // The angles cover the whole circle, so that z and w each are the largest component, with both
  // signs.
  for (int i = 1; i <= 40; ++i) {
    simulation_->Advance(seconds(1));
    Round(seconds(1));
    const auto poses = Decoded<Poses>(client_->data(1).back());
    const auto packed = Decoded<PackedPoses>(client_->data(2).back());
    EXPECT_EQ(packed.step, poses.step);
    EXPECT_EQ(packed.stamp, poses.stamp);
    EXPECT_EQ(packed.layout_version, poses.layout_version);
    const std::size_t entries = poses.poses.size() / 7;
    ASSERT_EQ(packed.positions.size(), 3 * entries);
    ASSERT_EQ(packed.rotations.size(), 3 * entries);
    for (std::size_t entry = 0; entry < entries; ++entry) {
      const double* pose = &poses.poses[7 * entry];
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_NEAR(packed.positions[3 * entry + k] * 1e-4, pose[k], 0.51e-4);
      }
      EXPECT_LT(AngleBetween(Unpacked(&packed.rotations[3 * entry]), pose + 3), 2e-4);
    }
  }
}

TEST_F(LiveStreamTest, PackedPosesAreSentAtMostTwentyTimesPerSecond) {
  Subscribe(1, "/gsv/packed_poses");
  for (int i = 0; i < 1000; ++i) {
    simulation_->Advance(milliseconds(1));
    Round(milliseconds(1));
  }
  EXPECT_GE(client_->data(1).size(), 19u);
  EXPECT_LE(client_->data(1).size(), 21u);
}

TEST_F(LiveStreamTest, PackedPosesOfACrowdStayBelowTheByteLimit) {
  for (int i = 0; i < 500; ++i) simulation_->AddOneRobot();
  Round();
  Subscribe(1, "/gsv/packed_poses");
  for (int i = 0; i < 200; ++i) {
    simulation_->Advance(milliseconds(10));
    Round(milliseconds(10));
  }
  std::size_t bytes = 0;
  for (const auto& each : client_->data(1)) bytes += each.payload.size();
  EXPECT_LT(bytes, 2 * kMaxSnapshotBytesPerSecond * 1.1);
  EXPECT_GT(bytes, 2 * kMaxSnapshotBytesPerSecond * 0.8);
}

}  // namespace
}  // namespace gsv::gateway
