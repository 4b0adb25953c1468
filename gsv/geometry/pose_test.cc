#include "gsv/geometry/pose.h"

#include <gtest/gtest.h>

#include "gsv/geometry/constants.h"

namespace gsv::geometry {
namespace {

void ExpectNear(const Vector3& a, const Vector3& b) {
  EXPECT_NEAR(a.x, b.x, 1e-12);
  EXPECT_NEAR(a.y, b.y, 1e-12);
  EXPECT_NEAR(a.z, b.z, 1e-12);
}

TEST(Quaternion, TurnsXToYByAQuarterTurnAboutZ) {
  ExpectNear(FromAxisAngle({0, 0, 1}, kPi / 2) * Vector3{1, 0, 0}, {0, 1, 0});
}

TEST(Quaternion, RollPitchYawTurnsAboutTheFixedAxesInThatOrder) {
  // A roll of 90° makes the y axis point up. A following yaw of 90° does not change that.
  const Quaternion q = FromRollPitchYaw({kPi / 2, 0, kPi / 2});
  ExpectNear(q * Vector3{0, 1, 0}, {0, 0, 1});
  ExpectNear(q * Vector3{1, 0, 0}, {0, 1, 0});
}

TEST(Quaternion, RollPitchYawIsRecovered) {
  for (const double roll : {-3.0, -0.4, 0.0, 1.1}) {
    for (const double pitch : {-1.5, 0.0, 0.7}) {
      for (const double yaw : {-2.0, 0.0, 3.1}) {
        const RollPitchYaw back = ToRollPitchYaw(FromRollPitchYaw({roll, pitch, yaw}));
        EXPECT_NEAR(back.roll, roll, 1e-9);
        EXPECT_NEAR(back.pitch, pitch, 1e-9);
        EXPECT_NEAR(back.yaw, yaw, 1e-9);
      }
    }
  }
}

TEST(Quaternion, RotationIsRecoveredAtGimbalLock) {
  const Quaternion q = FromRollPitchYaw({0.3, kPi / 2, 0.5});
  const RollPitchYaw angles = ToRollPitchYaw(q);
  EXPECT_EQ(angles.roll, 0.0);
  ExpectNear(FromRollPitchYaw(angles) * Vector3{1, 2, 3}, q * Vector3{1, 2, 3});
}

TEST(Pose, ComposesAndInverts) {
  const Pose world_from_robot = PlanarPose(2, 1, 0, kPi / 2);
  const Pose robot_from_sonar = PlanarPose(0.5, 0, 0.3, 0);
  ExpectNear((world_from_robot * robot_from_sonar) * Vector3{1, 0, 0}, {2, 2.5, 0.3});
  ExpectNear((Inverse(world_from_robot) * world_from_robot) * Vector3{4, 5, 6}, {4, 5, 6});
}

TEST(WrapAngle, LiesInTheHalfOpenInterval) {
  EXPECT_NEAR(WrapAngle(3 * kPi), kPi, 1e-12);
  EXPECT_NEAR(WrapAngle(-kPi), kPi, 1e-12);
  EXPECT_NEAR(WrapAngle(2 * kPi + 0.25), 0.25, 1e-12);
}

}  // namespace
}  // namespace gsv::geometry
