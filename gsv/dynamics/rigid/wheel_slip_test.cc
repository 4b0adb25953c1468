// Tests wheels that slip in proportion to their force against the equations of gz-sim's WheelSlip.
#include <gtest/gtest.h>

#include "gsv/base/test_within.h"
#include "gsv/dynamics/testing/test_rigid_world.h"

namespace gsv::dynamics {
namespace {

using geometry::Pose;
using geometry::Vector3;
using testing::At;
using testing::kG;
using testing::SolidOf;
using testing::TestWorld;
using testing::WorldOnGround;

constexpr double kRadius = 0.1, kWheelbase = 0.5, kTrack = 0.4;  // m
constexpr double kMassOfAll = 10;                                // kg

// Four wheels that touch the ground in one point each.
std::shared_ptr<model::Model> Rover(const model::Slip& slip) {
  auto model = SolidOf(geometry::Box{{0.6, 0.2, 0.1}}, kMassOfAll - 2);
  model->drive = model::Drive{};
  model->drive->wheel_radius = kRadius;
  model->drive->wheel_separation = kTrack;
  model->drive->slip = slip;
  for (const double y : {kTrack / 2, -kTrack / 2}) {
    for (const double x : {kWheelbase / 2, -kWheelbase / 2}) {
      model::Joint joint;
      joint.kind = model::JointKind::kContinuous;
      joint.parent = 0;
      joint.child = static_cast<int>(model->links.size());
      joint.axis = {0, 1, 0};
      joint.model_from_joint = At(x, y, 0);
      (y > 0 ? model->drive->left_wheels : model->drive->right_wheels)
          .push_back(static_cast<int>(model->joints.size()));
      model->joints.push_back(joint);
      model->links.push_back(SolidOf(geometry::Sphere{kRadius}, 0.5)->links[0]);
      model->links.back().model_from_link = joint.model_from_joint;
    }
  }
  return model;
}

// m/s: a steady speed approaches its closed form as exp(-g t / C) with the compliance C. At t = 5 s
// and C = 3, 8e-8 m/s are left. The solver adds at most 1e-9 m/s in a substep.
constexpr double kSeconds = 5, kSteady = 1e-6;

// Returns the steady speed, in m/s up a slope of `angle`, with wheels that turn at 1 m/s.
double SpeedUphill(const std::shared_ptr<model::Model>& rover, double angle,
                   const model::Surface& ground = {}) {
  const geometry::Quaternion turn = geometry::FromAxisAngle({0, 1, 0}, -angle);
  TestWorld world(MakeWorldEngine());
  world.AddStatic("slope", testing::GroundOf(ground), {{}, turn});
  world.AddRigid("rover", rover, {turn * Vector3{0, 0, kRadius}, turn});
  EXPECT_TRUE(world.Start());
  world.Command("rover", {1, 0, 0});
  world.Run(kSeconds, 0.001);
  EXPECT_NEAR(std::abs(world.joint_velocity("rover", 0)), 1 / kRadius, 1e-6);
  return (Inverse(turn) * world.body("rover").linear_velocity).x;
}

TEST(WheelSlip, SlipRatioIsTheComplianceTimesThePullOverTheLoad) {
  const double angle = 0.1;
  for (const double compliance : {0.0, 0.5, 1.0, 3.0}) {
    EXPECT_WITHIN(SpeedUphill(Rover({compliance, 0}), angle), 1 - compliance * std::sin(angle),
                  kSteady, "m/s")
        << compliance;
  }
}

TEST(WheelSlip, UsesTheLoadThatAWheelSpecifies) {
  const double angle = 0.1, load = 50;
  auto rover = Rover({});
  for (std::size_t i = 1; i < 5; ++i) {
    rover->links[i].wheel = model::SlippingWheel{{1, 1}, load, kRadius};
  }
  const double pull = kMassOfAll * kG * std::sin(angle) / 4;
  EXPECT_WITHIN(SpeedUphill(rover, angle), 1 - pull / load, kSteady, "m/s");
}

TEST(WheelSlip, SoftGroundMakesEveryWheelSlip) {
  model::Surface sand;
  sand.wheel_slip = {2, 2};
  EXPECT_WITHIN(SpeedUphill(Rover({}), 0.1, sand), 1 - 2 * std::sin(0.1), kSteady, "m/s");
  EXPECT_WITHIN(SpeedUphill(Rover({1, 1}), 0.1, sand), 1 - 3 * std::sin(0.1), kSteady, "m/s");
}

// Returns the turn rate, in rad/s, of a rover whose wheels turn as for 1 rad/s.
double TurnOf(const model::Slip& slip) {
  TestWorld world = WorldOnGround();
  world.AddRigid("rover", Rover(slip), At(0, 0, kRadius));
  EXPECT_TRUE(world.Start());
  world.Command("rover", {0, 0, 1});
  world.Run(2, 0.001);
  EXPECT_NEAR(std::abs(world.joint_velocity("rover", 0)), kTrack / 2 / kRadius, 1e-6);
  return world.body("rover").angular_velocity.z;
}

// The wheels turn as for 1 rad/s, and the rover turns at w rad/s. B is its track, and L its
// wheelbase. Each wheel slips along its rolling direction by (1 - w) B / 2 and sideways by w L / 2.
// The torques of the two slip forces cancel: (1 - w) B² / along = w L² / across.
TEST(WheelSlip, SkidSteeredRobotTurnsMoreSlowlyThanItsWheels) {
  for (const auto& [along, across] : {std::pair{2.0, 2.0}, {2.0, 6.0}, {3.0, 1.5}}) {
    const double b2 = kTrack * kTrack, l2 = kWheelbase * kWheelbase;
    EXPECT_WITHIN_PERCENT(TurnOf({along, across}), b2 / (b2 + l2 * along / across), 0.5)
        << along << " " << across;
  }
}

// A surface with <slip1> lets the box slide at slip * force. The velocity does not depend on the
// number of contact points among which the force is divided.
TEST(WheelSlip, BoxOnASlipperySurfaceCreepsInProportionToItsWeight) {
  const double angle = 0.2, slip = 0.02;
  const geometry::Quaternion turn = geometry::FromAxisAngle({0, 1, 0}, angle);
  model::Surface surface;
  surface.slip = surface.slip2 = slip;
  TestWorld world(MakeWorldEngine());
  world.AddStatic("slope", testing::GroundOf(surface), {{}, turn});
  world.AddRigid("box", SolidOf(geometry::Box{{0.4, 0.3, 0.02}}, 2),
                 {turn * Vector3{0, 0, 0.01}, turn});
  ASSERT_TRUE(world.Start());
  world.Run(2, 0.001);
  EXPECT_WITHIN_PERCENT((Inverse(turn) * world.body("box").linear_velocity).x,
                        slip * 2 * kG * std::sin(angle), 0.5);
}

}  // namespace
}  // namespace gsv::dynamics
