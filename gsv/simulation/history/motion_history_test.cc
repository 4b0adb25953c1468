#include "gsv/simulation/history/motion_history.h"

#include <gtest/gtest.h>

namespace gsv::simulation {
namespace {

using namespace std::chrono_literals;

constexpr SimTime kStep = 10ms;

// Makes snapshots of a robot and a wall with given states.
class MotionHistoryTest : public ::testing::Test {
 protected:
  MotionHistoryTest() {
    auto model = std::make_shared<model::Model>();
    model->name = "cart";
    model->links.resize(1);
    model->drive.emplace();
    model->drive->command_timeout = SimTime(0);
    model_ = model;
    world::Body robot;
    robot.name = "robot";
    robot.model = model;
    robot.kind = world::BodyKind::kPlanarBase;
    world::Body wall;
    wall.name = "wall";
    auto wall_model = std::make_shared<model::Model>();
    wall_model->links.resize(1);
    wall.model = wall_model;
    wall.kind = world::BodyKind::kStatic;
    snapshot_.layout =
        world::MakeLayout(1, {robot, wall}, std::make_shared<model::WorldDescription>());
    snapshot_.state.bodies.resize(2);
    history_.Follow(snapshot_);
  }

  world::BodyState& robot() { return snapshot_.state.bodies[0]; }

  // Takes steps in which the robot moves along x at this speed.
  void Run(SimTime duration, double speed) {
    for (SimTime end = snapshot_.state.time + duration; snapshot_.state.time < end;) {
      snapshot_.state.time += kStep;
      robot().world_from_model.position.x += speed * base::ToSeconds(kStep);
      history_.Follow(snapshot_);
    }
  }
  Motion Now() const { return history_.Of(snapshot_, 0); }

  std::shared_ptr<model::Model> model_;
  world::Snapshot snapshot_;
  MotionHistory history_;
};

TEST_F(MotionHistoryTest, ARobotThatNeverMovedIsAtRestSinceTheStart) {
  Run(3s, 0);
  EXPECT_FALSE(Now().is_moving);
  EXPECT_FALSE(Now().has_moved);
  EXPECT_EQ(Now().since, 0s);
}

TEST_F(MotionHistoryTest, MeasuresSinceWhenARobotMovesOrIsAtRest) {
  Run(2s, 0);
  Run(4s, 0.5);
  EXPECT_TRUE(Now().is_moving);
  EXPECT_EQ(Now().since, 2100ms);
  Run(900ms, 0);
  EXPECT_TRUE(Now().is_moving);
  Run(3100ms, 0);
  EXPECT_FALSE(Now().is_moving);
  EXPECT_EQ(Now().since, 6s);
}

TEST_F(MotionHistoryTest, CreepingIsNotMoving) {
  Run(2s, 0.5);
  for (int i = 0; i < 100; ++i) {
    Run(100ms, 0.005);
    EXPECT_EQ(Now().is_moving, i < 9) << i;
  }
  EXPECT_EQ(Now().since, 2s);
}

TEST_F(MotionHistoryTest, TurningIsMoving) {
  Run(1s, 0);
  robot().world_from_model.orientation = geometry::FromAxisAngle({0, 0, 1}, 0.03);
  Run(100ms, 0);
  EXPECT_TRUE(Now().is_moving);
}

TEST_F(MotionHistoryTest, IsStuckIfACommandHasNoEffectForTheGivenTime) {
  Run(3s, 0.5);
  robot().drive.command.linear = 0.5;
  Run(4900ms, 0);
  EXPECT_FALSE(IsStuck(Now(), 5s));
  Run(200ms, 0);
  EXPECT_TRUE(IsStuck(Now(), 5s));
  robot().drive.command = {};
  Run(100ms, 0);
  EXPECT_FALSE(IsStuck(Now(), 5s)) << "it is not commanded to move any more";
  robot().drive.command.linear = 0.5;
  Run(500ms, 0.5);
  EXPECT_FALSE(IsStuck(Now(), 5s)) << "it moves";
  EXPECT_EQ(Now().commanded_for, 0s);
}

TEST_F(MotionHistoryTest, ACommandEndsWithItsTimeout) {
  model_->drive->command_timeout = 500ms;
  robot().drive.command.linear = 0.5;
  Run(10s, 0);
  EXPECT_EQ(Now().command, world::DriveCommand{});
  EXPECT_LT(Now().commanded_for, 1s);
}

TEST_F(MotionHistoryTest, AnEarlierTimeBeginsANewHistory) {
  Run(3s, 0.5);
  snapshot_.state.time = 0s;
  history_.Follow(snapshot_);
  EXPECT_FALSE(Now().has_moved);
  EXPECT_EQ(Now().since, 0s);
}

TEST_F(MotionHistoryTest, KeepsTheHistoryOfARobotWhenAnotherOneIsAdded) {
  Run(3s, 0.5);
  Run(2s, 0);
  world::Body first = snapshot_.layout->bodies[0];
  first.name = "another";
  snapshot_.layout =
      world::MakeLayout(2, {first, snapshot_.layout->bodies[0], snapshot_.layout->bodies[1]},
                        std::make_shared<model::WorldDescription>());
  snapshot_.state.bodies.insert(snapshot_.state.bodies.begin(), world::BodyState{});
  snapshot_.state.time += kStep;
  history_.Follow(snapshot_);
  EXPECT_EQ(history_.Of(snapshot_, 1).since, 3s);
  EXPECT_FALSE(history_.Of(snapshot_, 0).has_moved);
}

TEST_F(MotionHistoryTest, NamesTheContactPartnerOfBothBodies) {
  world::Contact carried;
  carried.first = 0;
  carried.second = 1;
  carried.supports = true;
  snapshot_.contacts = {carried};
  EXPECT_EQ(ContactPartners(snapshot_), (std::vector<int>{-1, -1}));
  carried.supports = false;
  snapshot_.contacts = {carried};
  EXPECT_EQ(ContactPartners(snapshot_), (std::vector<int>{1, 0}));
}

}  // namespace
}  // namespace gsv::simulation
