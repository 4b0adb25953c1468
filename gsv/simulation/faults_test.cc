// Tests the faults of scenarios.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gsv/simulation/testing/test_simulation.h"

namespace gsv::simulation {
namespace {

using scenario::Fault;
using ::testing::HasSubstr;

std::shared_ptr<Simulation> WithFault(Fault fault, SimTime duration = 4s) {
  Specification specification = Lockstep(duration);
  fault.source.text = "t.yaml:1:1";
  specification.faults = {std::move(fault)};
  return Make(std::move(specification));
}

Fault At(double time, Fault::Kind kind, std::string body, std::string part = "") {
  Fault fault;
  fault.kind = kind;
  fault.at = time;
  fault.body = std::move(body);
  fault.part = std::move(part);
  return fault;
}

double XAtTheEnd(const Simulation& simulation) {
  return StatusOf(simulation, "r").world_from_robot.position.x;
}

TEST(Faults, FailedMotorStopsTheRobot) {
  const auto simulation = WithFault(At(1, Fault::Kind::kMotorFails, "r"));
  ASSERT_TRUE(simulation->AddRobot(Robot("r", 0, 0, Drives(0.5))));
  EXPECT_EQ(RunToEnd(*simulation), Phase::kFinished);
  EXPECT_NEAR(XAtTheEnd(*simulation), 0.5, 0.006);
  const std::string hash = simulation->state_hash();
  // After a reset, the motor fails again at the same time.
  ASSERT_TRUE(simulation->Reset());
  EXPECT_EQ(RunToEnd(*simulation), Phase::kFinished);
  EXPECT_EQ(simulation->state_hash(), hash);
}

TEST(Faults, KilledBehaviourSendsNoMoreCommands) {
  const auto simulation = WithFault(At(1, Fault::Kind::kBehaviourDies, "r"));
  ASSERT_TRUE(simulation->AddRobot(Robot("r", 0, 0, Drives(0.5))));
  EXPECT_EQ(RunToEnd(*simulation), Phase::kFinished);
  EXPECT_NEAR(XAtTheEnd(*simulation), 0.5, 0.03);
  EXPECT_EQ(StatusOf(*simulation, "r").phase, AgentPhase::kDead);
}

TEST(Faults, SilentSensorKeepsItsSampleAndFailedSensorReturnsAnError) {
  for (const auto kind : {Fault::Kind::kSensorSilent, Fault::Kind::kSensorError}) {
    const auto simulation = WithFault(At(1, kind, "r", "front"), 2s);
    ASSERT_TRUE(simulation->AddRobot(Robot("r", 0, 0, Drives(0.5))));
    EXPECT_EQ(RunToEnd(*simulation), Phase::kFinished);
    const auto reading = simulation->Watch("r", "front");
    if (kind == Fault::Kind::kSensorError) {
      EXPECT_FALSE(reading);
      continue;
    }
    ASSERT_TRUE(reading);
    EXPECT_EQ(reading->time, 1s);
    EXPECT_NEAR(reading->values[0], 2.9 - 0.5, 0.006);
  }
}

TEST(Faults, MovedPartOfTheWorldReturnsAfterAReset) {
  Fault closes = At(1, Fault::Kind::kBodyMoves, "wall");
  closes.place = {2, 0, 0, 0};
  const auto simulation = WithFault(closes, 6s);
  ASSERT_TRUE(simulation->AddRobot(Robot("r", 0, 0, Drives(0.5))));
  EXPECT_EQ(RunToEnd(*simulation), Phase::kFinished);
  EXPECT_NEAR(XAtTheEnd(*simulation), 2 - 0.1 - 0.2, 0.01);
  EXPECT_LT(simulation->Watch("r", "front")->values[0], 5.0);
  const std::string hash = simulation->state_hash();
  ASSERT_TRUE(simulation->Reset());
  EXPECT_NEAR(simulation->Watch("r", "front")->values[0], 2.9, 1e-9);
  EXPECT_EQ(RunToEnd(*simulation), Phase::kFinished);
  EXPECT_EQ(simulation->state_hash(), hash);
}

TEST(Faults, ImpossibleFaultFailsTheRunAndTheErrorNamesItsLine) {
  Fault onto = At(1, Fault::Kind::kBodyMoves, "wall");
  onto.place = {0.5, 0, 0, 0};
  const auto simulation = WithFault(onto);
  ASSERT_TRUE(simulation->AddRobot(Robot("r", 0, 0, Drives(0.5))));
  EXPECT_EQ(RunToEnd(*simulation), Phase::kFailed);
  EXPECT_THAT(simulation->status().failure, HasSubstr("t.yaml:1:1: cannot apply the fault: "));
}

// A box with an arm on a joint. It moves by rigid-body dynamics.
RobotSpecification RobotWithAnArm() {
  auto model = std::make_shared<model::Model>(*Disc(0.2));
  model->links.emplace_back().name = "arm";
  model::Joint joint;
  joint.name = "hinge";
  joint.kind = model::JointKind::kRevolute;
  joint.parent = 0;
  joint.child = 1;
  model->joints.push_back(joint);
  RobotSpecification robot = Robot("r", 0, 0);
  robot.model = model;
  robot.movement = model::Movement::kRigid;
  return robot;
}

TEST(Faults, FaultOfARemovedJointFailsTheRunWithAReason) {
  const auto simulation = WithFault(At(1, Fault::Kind::kMotorFails, "r", "hinge"));
  ASSERT_TRUE(simulation->AddRobot(RobotWithAnArm()));
  ASSERT_TRUE(simulation->RunUntil(500ms));
  ASSERT_EQ(simulation->WaitForPhase({Phase::kPaused}, 20s), Phase::kPaused);
  ASSERT_TRUE(simulation->RemoveRobot("r"));
  ASSERT_TRUE(simulation->AddRobot(Robot("r", 0, 0)));
  ASSERT_TRUE(simulation->Resume());
  EXPECT_EQ(simulation->WaitForPhase({Phase::kFinished, Phase::kFailed}, 20s), Phase::kFailed);
  EXPECT_THAT(simulation->status().failure, HasSubstr("the joint does not exist any more: hinge"));
}

TEST(Faults, AFaultOfAMissingRobotPreventsTheStart) {
  for (const Fault& fault :
       {At(1, Fault::Kind::kMotorFails, "nobody"), At(1, Fault::Kind::kMotorFails, "wall"),
        At(1, Fault::Kind::kBehaviourDies, "r"), At(1, Fault::Kind::kJointMoves, "r", "hinge")}) {
    const auto simulation = WithFault(fault);
    ASSERT_TRUE(simulation->AddRobot(Robot("r", 0, 0)));
    const auto started = simulation->Start();
    ASSERT_FALSE(started);
    EXPECT_EQ(started.error().where, "t.yaml:1:1");
  }
}

}  // namespace
}  // namespace gsv::simulation
