// Tests that the effect of a command is the same for every heading, and follows the command or
// Coulomb's friction.
#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "gsv/base/test_within.h"
#include "gsv/dynamics/testing/test_rigid_world.h"
#include "gsv/geometry/constants.h"

namespace gsv::dynamics::headings {
namespace {

using geometry::kPi;
using geometry::Pose;
using geometry::Vector3;
using model::DriveKind;
using testing::At;
using testing::TestWorld;
using testing::WorldOnGround;

constexpr double kRadius = 0.1;  // m, of wheels

// A box of 10 kg without wheels. Its centre is `height` above the ground.
std::shared_ptr<model::Model> Body(const Vector3& size, double height) {
  auto model = std::make_shared<model::Model>();
  model->name = "robot";
  model::Link base;
  base.name = "base";
  base.model_from_link = At(0, 0, height);
  base.inertial = {10, At(0, 0, 0), 0.2, 0.3, 0.4};
  base.collisions.push_back({"box", {}, geometry::Box{size}, {}});
  model->links.push_back(base);
  model->drive = model::Drive{};
  model->drive->linear_acceleration = {-1, 1};
  model->drive->angular_acceleration = {-2, 2};
  model->movement = model::Movement::kRigid;
  return model;
}

// A wheel that touches the ground at one point. A steered wheel has a steering link as its parent.
void AddWheel(model::Model& model, double x, double y, bool is_steered = false) {
  int parent = 0;
  const auto add = [&](const std::string& name, const Vector3& axis, double mass) {
    model::Link link;
    link.name = name;
    link.model_from_link = At(x, y, kRadius);
    link.inertial = {mass, {}, 0.002 * mass, 0.002 * mass, 0.002 * mass};
    model.links.push_back(link);
    model::Joint joint;
    joint.name = name + "_joint";
    joint.kind = model::JointKind::kContinuous;
    joint.parent = parent;
    joint.child = parent = static_cast<int>(model.links.size()) - 1;
    joint.model_from_joint = At(x, y, kRadius);
    joint.axis = axis;
    model.joints.push_back(joint);
    return static_cast<int>(model.joints.size()) - 1;
  };
  const std::string name = std::to_string(model.joints.size());
  if (is_steered) model.drive->steered.push_back(add("knuckle" + name, {0, 0, 1}, 0.3));
  const int wheel = add("wheel" + name, {0, 1, 0}, 0.5);
  model.links.back().collisions.push_back({"tyre", {}, geometry::Sphere{kRadius}, {1, 1, 0}});
  (y > 0 ? model.drive->left_wheels : model.drive->right_wheels).push_back(wheel);
  model.drive->wheel_radius = kRadius;
  model.drive->wheel_separation = 2 * std::abs(y);
}

std::shared_ptr<model::Model> TwoWheels() {
  auto model = Body({0.4, 0.24, 0.1}, 0.1);
  for (const double side : {1.0, -1.0}) AddWheel(*model, 0, side * 0.15);
  for (const double x : {-0.15, 0.15}) {
    model->links[0].collisions.push_back(
        {"caster", At(x, 0, -0.07), geometry::Sphere{0.03}, {0, 0, 0}});
  }
  return model;
}

constexpr double kTrack = 0.4, kBase = 0.34;  // m

std::shared_ptr<model::Model> FourWheels() {
  auto model = Body({0.5, 0.25, 0.1}, 0.17);
  for (const double x : {kBase / 2, -kBase / 2}) {
    for (const double side : {1.0, -1.0}) AddWheel(*model, x, side * kTrack / 2);
  }
  return model;
}

std::shared_ptr<model::Model> Car() {
  auto model = Body({0.5, 0.2, 0.1}, 0.17);
  model->drive->kind = DriveKind::kAckermann;
  model->drive->wheel_base = kBase;
  for (const double side : {1.0, -1.0}) {
    AddWheel(*model, kBase / 2, side * kTrack / 2, true);
    AddWheel(*model, -kBase / 2, side * kTrack / 2);
  }
  return model;
}

// A tall box that stands on its lower face.
std::shared_ptr<model::Model> Held(DriveKind kind) {
  auto model = Body({0.3, 0.3, 1.2}, 0.6);
  model->drive->kind = kind;
  return model;
}

std::shared_ptr<model::Model> FourWheelsHeld() {
  auto model = FourWheels();
  model->drive->kind = DriveKind::kMecanum;
  model->drive->wheel_base = kBase;
  return model;
}

struct Outcome {
  double forward = 0, left = 0, angle = 0, tilt = 0;
};

constexpr double kSeconds = 1;

Outcome Drive(const std::shared_ptr<model::Model>& model, const world::DriveCommand& command,
              double heading, world::BodyKind kind) {
  TestWorld world = WorldOnGround();
  const Pose start{{0.3, -0.2, 0}, geometry::FromAxisAngle({0, 0, 1}, heading)};
  if (kind == world::BodyKind::kRigidBody) {
    world.AddRigid("robot", model, start);
  } else {
    world.AddRobot("robot", model, start);
  }
  EXPECT_TRUE(world.Start());
  world.Command("robot", command);
  world.Run(kSeconds, 0.01);
  const Pose start_from_end = Inverse(start) * world.body("robot").world_from_model;
  const Vector3 up = start_from_end.orientation * Vector3{0, 0, 1};
  return {start_from_end.position.x, start_from_end.position.y,
          geometry::Yaw(start_from_end.orientation), std::acos(std::min(up.z, 1.0))};
}

struct Case {
  const char* name;
  std::shared_ptr<model::Model> model;
  world::DriveCommand command;
  double turned = 1;  // the robot's rotation, as a fraction of the commanded angle
};

// Coulomb's friction at four points of equal load, whose wheels rotate as commanded. In a rotation
// about the centre, each point slips along and across its wheel. The moments are in balance if the
// robot rotates by the fraction B² / (B² + L²) of the command.
constexpr double kSkids = kTrack * kTrack / (kTrack * kTrack + kBase * kBase);

std::vector<Case> Cases() {
  const world::DriveCommand forward{0.4, 0, 0}, turn{0, 0, 0.5}, arc{0.4, 0, 0.5};
  const world::DriveCommand aslant{0.3, 0.3, 0};
  std::vector<Case> cases{
      {"two wheels, forward", TwoWheels(), forward},
      {"two wheels, turn", TwoWheels(), turn},
      {"two wheels, arc", TwoWheels(), arc},
      {"four wheels, forward", FourWheels(), forward},
      {"four wheels, turn", FourWheels(), turn, kSkids},
      {"car, forward", Car(), forward},
      {"car, arc", Car(), arc},
      {"mecanum, aslant", FourWheelsHeld(), aslant},
      {"mecanum, turn", FourWheelsHeld(), turn},
      {"mecanum, a box, aslant", Held(DriveKind::kMecanum), aslant},
  };
  for (const DriveKind kind : {DriveKind::kSynchro, DriveKind::kVelocity}) {
    cases.push_back({"held, forward", Held(kind), forward});
    cases.push_back({"held, turn", Held(kind), turn});
    cases.push_back({"held, arc", Held(kind), arc});
  }
  return cases;
}

// Returns the motion along arcs, within the limits of acceleration. Skidding robots turn less than
// commanded.
Outcome Expected(const Case& c) {
  const double share = c.turned;
  Outcome outcome;
  constexpr double kStep = 1e-4;
  for (double time = 0; time < kSeconds; time += kStep) {
    const auto follow = [&](double told, double most) {
      return std::copysign(std::min(std::abs(told), most * time), told);
    };
    const double v = follow(c.command.linear, 1), u = follow(c.command.lateral, 1);
    outcome.angle += share * follow(c.command.angular, 2) * kStep;
    outcome.forward += (v * std::cos(outcome.angle) - u * std::sin(outcome.angle)) * kStep;
    outcome.left += (v * std::sin(outcome.angle) + u * std::cos(outcome.angle)) * kStep;
  }
  return outcome;
}

TEST(Headings, CommandHasTheSameEffectForEveryHeading) {
  for (const Case& c : Cases()) {
    for (const auto kind : {world::BodyKind::kRigidBody, world::BodyKind::kPlanarBase}) {
      Case of = c;
      if (kind == world::BodyKind::kPlanarBase) of.turned = 1;
      const Outcome expected = Expected(of);
      // The radius of a car's arc is measured at its rear axle.
      const bool is_car = c.model->drive->kind == DriveKind::kAckermann;
      for (int i = 0; i < 8; ++i) {
        const double heading = i * kPi / 4 + 0.1;
        const Outcome is = Drive(c.model, c.command, heading, kind);
        const std::string where = std::string(c.name) + " at " + std::to_string(heading) +
                                  " rad, kind " + std::to_string(static_cast<int>(kind));
        EXPECT_WITHIN(is.angle, expected.angle, 0.02, "rad") << where;
        EXPECT_WITHIN(is.tilt, 0, 0.01, "rad") << where;
        const double ahead = is_car ? kBase / 2 : 0;
        const double rear_forward = is.forward - ahead * std::cos(is.angle) + ahead;
        const double rear_left = is.left - ahead * std::sin(is.angle);
        EXPECT_WITHIN(rear_forward, expected.forward, 0.015, "m") << where;
        EXPECT_WITHIN(rear_left, expected.left, 0.015, "m") << where;
      }
    }
  }
}

TEST(Headings, SkidSteeredRobotTurnsEquallyAtEachHeading) {
  const auto model = FourWheels();
  double least = 10, most = 0;
  for (int i = 0; i < 8; ++i) {
    const double heading = i * kPi / 16;
    const Outcome is = Drive(model, {0, 0, 0.5}, heading, world::BodyKind::kRigidBody);
    least = std::min(least, is.angle);
    most = std::max(most, is.angle);
  }
  EXPECT_WITHIN_PERCENT(most, least, 1);
}

}  // namespace
}  // namespace gsv::dynamics::headings
