// Tests that robots from files drive as commanded, and equally for every heading. The robots are
// the built-in ones, and those in the folder GSV_REAL_DIR if it is set.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <vector>

#include <gtest/gtest.h>

#include "gsv/base/test_within.h"
#include "gsv/dynamics/motion/drive_kinematics.h"
#include "gsv/dynamics/motion/drive_servo.h"
#include "gsv/dynamics/testing/test_rigid_world.h"
#include "gsv/formats/sdf_reader.h"
#include "gsv/formats/testing/real_folder.h"
#include "gsv/geometry/constants.h"
#include "gsv/model/drive_choice.h"
#include "tests/structure/coulomb_motion.h"

namespace gsv {
namespace {

namespace fs = std::filesystem;
using dynamics::testing::TestWorld;
using geometry::Pose;
using geometry::Vector3;

constexpr double kStep = 0.01, kSettling = 0.3, kStarting = 0.7, kSeconds = 0.5;  // in s
constexpr int kHeadings = 8;
constexpr int kLawEvery = 5;  // steps between evaluations of the law

// Tolerance in m and rad for planar kinematics and for robots that move exactly as commanded.
constexpr double kExact = 2e-3;
// For robots that roll: the maximum deviation from the motion by Coulomb's law (coulomb_motion.h),
// as a fraction of the command.
constexpr double kCoulomb = 0.05;
// The maximum angle in rad by which a robot on its wheels leans.
constexpr double kLeans = 0.25;

// The position of the robot's origin after the run in the frame of its start, its maximum lean, and
// its mean motion over the last half of the run.
struct Outcome {
  double forward = 0, left = 0, angle = 0, lean = 0;
  GroundMotion motion;
  double way() const { return std::hypot(forward, left); }
};

// A run, the motion that the drive commanded during the run, and the motion that follows from the
// wheels' speeds by Coulomb's law.
struct Run {
  Outcome is, commanded;
  std::optional<CoulombRange> by_law;
};

Outcome OutcomeOf(const Pose& start_from_end) {
  return {start_from_end.position.x,
          start_from_end.position.y,
          geometry::Yaw(start_from_end.orientation),
          0,
          {}};
}

void AddShare(const GroundMotion& motion, double share, GroundMotion& sum) {
  sum.x += share * motion.x;
  sum.y += share * motion.y;
  sum.turn += share * motion.turn;
}

void AddShare(const CoulombRange& range, double share, CoulombRange& sum) {
  AddShare(range.both, share, sum.both);
  AddShare(range.min, share, sum.min);
  AddShare(range.max, share, sum.max);
}

// Starts the robot. Its motion is steady when the run begins.
TestWorld Started(const std::shared_ptr<const model::Model>& model,
                  const world::DriveCommand& command, double heading, world::BodyKind kind) {
  TestWorld world = dynamics::testing::WorldOnGround();
  const Pose stands{{0.3, -0.2, -model::LowestPoint(*model)},
                    geometry::FromAxisAngle({0, 0, 1}, heading)};
  if (kind == world::BodyKind::kRigidBody) {
    world.AddRigid("robot", model, stands);
  } else {
    world.AddRobot("robot", model, stands);
  }
  EXPECT_TRUE(world.Start());
  world.Run(kSettling, kStep);
  for (int i = 0; i < static_cast<int>(kStarting / kStep + 0.5); ++i) {
    // The command is repeated, because drives stop without commands.
    world.Command("robot", command);
    world.Step(kStep);
  }
  return world;
}

Run Drive(const std::shared_ptr<const model::Model>& model, const world::DriveCommand& command,
          double heading, world::BodyKind kind) {
  TestWorld world = Started(model, command, heading, kind);
  const int body = world.layout().Find("robot");
  const Pose start = world.body("robot").world_from_model;
  const Pose upright{start.position,
                     geometry::FromAxisAngle({0, 0, 1}, geometry::Yaw(start.orientation))};
  const auto kinematics = dynamics::DriveKinematics::Create(*model);
  Pose commanded;
  GroundMotion motion;
  CoulombRange by_law{};
  const int steps = static_cast<int>(kSeconds / kStep + 0.5), averaged = steps / 2;
  int judged = 0, with_law = 0;
  for (int i = 0; i < steps; ++i) {
    world.Command("robot", command);
    const auto contacts = world.Step(kStep);
    const geometry::Twist twist = kinematics->OriginTwist(world.body("robot").drive.actual);
    const double yaw = geometry::Yaw(commanded.orientation);
    const double middle = yaw + twist.angular * kStep / 2;
    commanded.position.x += kStep * (twist.x * std::cos(middle) - twist.y * std::sin(middle));
    commanded.position.y += kStep * (twist.x * std::sin(middle) + twist.y * std::cos(middle));
    commanded.orientation = geometry::FromAxisAngle({0, 0, 1}, yaw + twist.angular * kStep);
    if (i < steps - averaged) continue;
    AddShare(MotionOf(world.body("robot")), 1.0 / averaged, motion);
    if (kind != world::BodyKind::kRigidBody || i % kLawEvery != 0) continue;
    ++judged;
    const auto law = CoulombMotion(world, body, contacts);
    if (law) AddShare(*law, 1, by_law);
    with_law += law.has_value();
  }
  Run run{
      OutcomeOf(Inverse(upright) * world.body("robot").world_from_model), OutcomeOf(commanded), {}};
  if (with_law == judged && judged > 0) {
    run.by_law.emplace();
    AddShare(by_law, 1.0 / with_law, *run.by_law);
  }
  const Vector3 up = world.body("robot").world_from_model.orientation * Vector3{0, 0, 1};
  run.is.lean = std::acos(std::min(up.z, 1.0));
  run.is.motion = motion;
  return run;
}

void Print(const Run& run, const std::string& where) {
  if (std::getenv("GSV_PRINT_HEADINGS") == nullptr) return;
  const GroundMotion law = run.by_law.value_or(CoulombRange{}).both;
  std::printf(
      "%s: forward %.4f (%.4f) left %.4f (%.4f) angle %.4f (%.4f) lean %.4f; "
      "x %.4f (%.4f) y %.4f (%.4f) turn %.4f (%.4f)\n",
      where.c_str(), run.is.forward, run.commanded.forward, run.is.left, run.commanded.left,
      run.is.angle, run.commanded.angle, run.is.lean, run.is.motion.x, law.x, run.is.motion.y,
      law.y, run.is.motion.turn, law.turn);
}

void ExpectAsCommanded(const Run& run, const std::string& where) {
  EXPECT_WITHIN(run.is.forward, run.commanded.forward, kExact, "m") << where;
  EXPECT_WITHIN(run.is.left, run.commanded.left, kExact, "m") << where;
  EXPECT_WITHIN(run.is.angle, run.commanded.angle, kExact, "rad") << where;
}

void ExpectInRange(double value, const CoulombRange& range, double GroundMotion::*part,
                   double tolerance, const std::string& where) {
  EXPECT_GE(value, range.min.*part - tolerance) << where;
  EXPECT_LE(value, range.max.*part + tolerance) << where;
}

void ExpectCoulombsLaw(const Run& run, const world::DriveCommand& command,
                       const model::Model& model, const std::string& where) {
  const double track = model.drive->wheel_separation;
  const double turn = std::abs(command.angular), speed = std::abs(command.linear);
  const double way = kCoulomb * (speed + turn * track / 2);
  const double angle = kCoulomb * (turn + 0.1 * speed);
  ASSERT_TRUE(run.by_law) << where << ": it is off the ground";
  ExpectInRange(run.is.motion.x, *run.by_law, &GroundMotion::x, way, where + ", x in m/s");
  ExpectInRange(run.is.motion.y, *run.by_law, &GroundMotion::y, way, where + ", y in m/s");
  ExpectInRange(run.is.motion.turn, *run.by_law, &GroundMotion::turn, angle,
                where + ", turn in rad/s");
}

void ExpectTheSame(const std::vector<Run>& runs, const world::DriveCommand& command,
                   const std::string& where) {
  const auto expect_same = [&](auto value) {
    const auto [least, most] = std::minmax_element(
        runs.begin(), runs.end(),
        [&](const Run& a, const Run& b) { return std::abs(value(a)) < std::abs(value(b)); });
    EXPECT_LE(std::abs(value(*most)), 1.05 * std::abs(value(*least))) << where;
  };
  if (command.angular != 0) expect_same([](const Run& run) { return run.is.angle; });
  if (command.linear != 0) expect_same([](const Run& run) { return run.is.way(); });
}

void ExpectToDrive(const std::shared_ptr<const model::Model>& model,
                   const world::DriveCommand& command, world::BodyKind kind) {
  const bool is_rigid = kind == world::BodyKind::kRigidBody;
  const std::string what = model->name + (is_rigid ? ", rigid, " : ", planar, ") +
                           std::to_string(command.linear) + " m/s, " +
                           std::to_string(command.angular) + " rad/s";
  std::vector<Run> runs;
  for (int i = 0; i < kHeadings; ++i) {
    const double heading = 2 * geometry::kPi * i / kHeadings + 0.1;
    const std::string where = what + ", heading " + std::to_string(heading);
    const Run& run = runs.emplace_back(Drive(model, command, heading, kind));
    Print(run, where);
    EXPECT_LE(run.is.lean, kLeans) << where;
    if (is_rigid && dynamics::RollsOnWheels(*model)) {
      ExpectCoulombsLaw(run, command, *model, where);
    } else {
      ExpectAsCommanded(run, where);
    }
  }
  ExpectTheSame(runs, command, what);
}

void ExpectToDriveFrom(const fs::path& file, formats::ModelLibrary& library) {
  base::Problems problems;
  const auto read = library.ReadModel(file.string(), problems);
  ASSERT_TRUE(read) << read.error().Sentence();
  const auto model = model::AsRobot(*read, "");
  ASSERT_TRUE(model) << model.error().Sentence();
  ASSERT_TRUE((*model)->drive) << file << " has no drive";
  const bool is_car = (*model)->drive->kind == model::DriveKind::kAckermann;
  for (const auto kind : {world::BodyKind::kPlanarBase, world::BodyKind::kRigidBody}) {
    ExpectToDrive(*model, {0.2, 0, 0}, kind);
    if (!is_car) ExpectToDrive(*model, {0, 0, 0.5}, kind);
    ExpectToDrive(*model, {0.2, 0, 0.3}, kind);
  }
}

class BuiltInRobots : public testing::TestWithParam<const char*> {};

TEST_P(BuiltInRobots, DriveEquallyInEachHeading) {
  const char* source = std::getenv("GSV_SOURCE_DIR");
  const fs::path models = fs::path(source == nullptr ? "." : source) / "assets" / "models";
  formats::ModelLibrary library{formats::ReadOptions{{models}, true, {}}};
  ExpectToDriveFrom(models / GetParam(), library);
}

INSTANTIATE_TEST_SUITE_P(Models, BuiltInRobots,
                         testing::Values("avatar", "b21r", "courier", "pebble", "porter",
                                         "rover4"));

class RealRobots : public testing::TestWithParam<const char*> {};

TEST_P(RealRobots, DriveEquallyInEachHeading) {
  const fs::path folder = formats::RealFolder();
  if (folder.empty()) GTEST_SKIP() << "GSV_REAL_DIR names no folder of other people's robots";
  formats::ModelLibrary library{formats::ReadOptions{
      {folder / "gazebo_models", folder / "turtlebot3" / "models", folder / "turtlebot3"},
      true,
      {}}};
  ExpectToDriveFrom(folder / GetParam(), library);
}

INSTANTIATE_TEST_SUITE_P(Models, RealRobots,
                         testing::Values("gazebo_models/create", "gazebo_models/pioneer2dx",
                                         "gazebo_models/pioneer3at", "gazebo_models/turtlebot",
                                         "turtlebot3/models/turtlebot3_burger",
                                         "turtlebot3/models/turtlebot3_waffle",
                                         "turtlebot3/models/turtlebot3_waffle_pi"));

}  // namespace
}  // namespace gsv
