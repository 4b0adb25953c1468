#include "apps/gsv/running/start_checks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gsv::app {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::shared_ptr<const model::Model> BoxOf(const geometry::Vector3& size) {
  auto model = std::make_shared<model::Model>();
  model->links.resize(1);
  model::Collision collision;
  collision.shape = geometry::Box{size};
  model->links[0].collisions.push_back(collision);
  return model;
}

// Walls of 1 m height around a square of 10 m.
std::vector<world::Body> Walls() {
  std::vector<world::Body> bodies;
  const auto add = [&](const char* name, const geometry::Vector3& size, double x, double y) {
    world::Body wall;
    wall.name = name;
    wall.model = BoxOf(size);
    wall.initial_pose = {{x, y, 0.5}, {}};
    wall.kind = world::BodyKind::kStatic;
    bodies.push_back(std::move(wall));
  };
  add("wall_east", {0.2, 10, 1}, 5, 0), add("wall_west", {0.2, 10, 1}, -5, 0);
  add("wall_north", {10, 0.2, 1}, 0, 5), add("wall_south", {10, 0.2, 1}, 0, -5);
  return bodies;
}

// Returns the warnings about a robot that starts at this pose.
std::vector<std::string> Warnings(std::vector<world::Body> bodies, double x, double y, double yaw,
                                  world::BodyKind kind = world::BodyKind::kPlanarBase) {
  world::Body robot;
  robot.name = "robot";
  auto model = std::make_shared<model::Model>(*BoxOf({0.3, 0.3, 0.3}));
  model->drive.emplace();
  robot.model = model;
  robot.initial_pose = geometry::PlanarPose(x, y, 0.15, yaw);
  robot.kind = kind;
  bodies.push_back(std::move(robot));
  auto snapshot = std::make_shared<world::Snapshot>();
  snapshot->layout =
      world::MakeLayout(1, std::move(bodies), std::make_shared<const model::WorldDescription>());
  snapshot->state = world::InitialState(*snapshot->layout);
  scenario::Scenario scenario;
  scenario.robots = {{.model = "pebble", .name = "robot", .start = scenario::Place{x, y, {}, yaw}}};
  std::vector<std::string> sentences;
  for (const base::Problem& problem : CheckStarts(snapshot, scenario)) {
    EXPECT_EQ(problem.severity, base::Problem::Severity::kWarning);
    sentences.push_back(problem.Sentence());
  }
  return sentences;
}

TEST(StartChecks, BodiesThatCanMoveAreNoWalls) {
  std::vector<world::Body> bodies = Walls();
  for (world::Body& body : bodies) body.kind = world::BodyKind::kRigidBody;
  EXPECT_THAT(Warnings(std::move(bodies), 7, 0, 0), IsEmpty());
}

TEST(StartChecks, StartBetweenWallsIsNoProblem) {
  EXPECT_THAT(Warnings(Walls(), 3, -4, 3.1), IsEmpty());
}

TEST(StartChecks, HeadingBeyondAFullTurnIsReported) {
  EXPECT_THAT(Warnings(Walls(), 0, 0, 90), ElementsAre(HasSubstr("pebble@0,0: its yaw of 90 rad")));
  EXPECT_THAT(Warnings(Walls(), 0, 0, 2 * 3.14159265358979), IsEmpty());
}

TEST(StartChecks, StartOutsideTheWallsIsReported) {
  EXPECT_THAT(Warnings(Walls(), 8, 0, 0), ElementsAre(HasSubstr("outside the walls")));
}

TEST(StartChecks, StartFarFromEverythingIsReported) {
  EXPECT_THAT(Warnings(Walls(), 300, 0, 0), ElementsAre(HasSubstr("295 m away from all objects")));
}

TEST(StartChecks, StartBesideBodiesWithoutAnEnclosureIsNoProblem) {
  std::vector<world::Body> one = Walls();
  one.resize(1);
  EXPECT_THAT(Warnings(one, 0, 0, 0), IsEmpty());
  EXPECT_THAT(Warnings({}, 1000, 0, 0), IsEmpty());
}

TEST(StartChecks, RigidRobotWithoutAFloorIsReported) {
  EXPECT_THAT(Warnings(Walls(), 0, 0, 0, world::BodyKind::kRigidBody),
              ElementsAre(HasSubstr("no ground below it")));
}

}  // namespace
}  // namespace gsv::app
