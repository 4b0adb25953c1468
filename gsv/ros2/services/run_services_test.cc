#include "gsv/ros2/services/run_services.h"

#include <gtest/gtest.h>

#include "gsv/simulation/testing/test_simulation.h"

namespace gsv::ros2 {
namespace {

using messages::simulation_interfaces::Result;
using messages::simulation_interfaces::SetSimulationStateResponse;
using messages::simulation_interfaces::SimulationState;
using simulation::Phase;

constexpr std::uint8_t kStopped = SimulationState::kStateStopped,
                       kPlaying = SimulationState::kStatePlaying,
                       kPaused = SimulationState::kStatePaused,
                       kQuitting = SimulationState::kStateQuitting;

class RunServicesTest : public ::testing::Test {
 protected:
  RunServicesTest() {
    auto specification = simulation::Lockstep(base::SimTime(0));
    specification.mode = simulation::Mode::kRealTime;
    simulation_ = simulation::Make(std::move(specification));
  }
  ~RunServicesTest() override { (void)simulation_->Stop(); }

  Result Enter(std::uint8_t state) { return EnterState(*simulation_, state); }
  bool Reaches(Phase phase) {
    return simulation_->WaitForPhase({phase}, simulation::kTimeout) == phase;
  }
  std::int64_t step() const { return simulation_->snapshot()->state.step; }

  std::shared_ptr<simulation::Simulation> simulation_;
};

TEST_F(RunServicesTest, PlaysPausesAndStops) {
  EXPECT_EQ(Enter(kPlaying).result, Result::kResultOk);
  EXPECT_TRUE(Reaches(Phase::kRunning));
  EXPECT_EQ(Enter(kPaused).result, Result::kResultOk);
  EXPECT_TRUE(Reaches(Phase::kPaused));
  EXPECT_EQ(Enter(kPlaying).result, Result::kResultOk);
  EXPECT_TRUE(Reaches(Phase::kRunning));
  EXPECT_EQ(Enter(kStopped).result, Result::kResultOk);
  EXPECT_TRUE(Reaches(Phase::kCreated));
  EXPECT_EQ(step(), 0);
}

TEST_F(RunServicesTest, PausesAStoppedSimulationBeforeItsFirstStep) {
  EXPECT_EQ(Enter(kPaused).result, Result::kResultOk);
  EXPECT_TRUE(Reaches(Phase::kPaused));
  EXPECT_EQ(step(), 0);
}

TEST_F(RunServicesTest, ReportsThatItIsInTheStateAlready) {
  EXPECT_EQ(Enter(kStopped).result, SetSimulationStateResponse::kAlreadyInTargetState);
  EXPECT_EQ(Enter(9).result, SetSimulationStateResponse::kIncorrectTransition);
}

TEST_F(RunServicesTest, LeavesTheEndedStateOnlyByAReset) {
  EXPECT_EQ(Enter(kQuitting).result, Result::kResultOk);
  EXPECT_TRUE(Reaches(Phase::kStopped));
  EXPECT_EQ(Enter(kPlaying).result, SetSimulationStateResponse::kIncorrectTransition);
  EXPECT_EQ(Enter(kStopped).result, Result::kResultOk);
  EXPECT_TRUE(Reaches(Phase::kCreated));
}

TEST_F(RunServicesTest, TakesStepsOfAPausedSimulationOnly) {
  const auto never = [] { return false; };
  EXPECT_TRUE(TakeSteps(*simulation_, 3, never));
  EXPECT_EQ(step(), 3);
  EXPECT_EQ(PhaseOf(*simulation_), Phase::kPaused);
  EXPECT_FALSE(TakeSteps(*simulation_, 0, never));
  EXPECT_FALSE(TakeSteps(*simulation_, std::uint64_t{1} << 63, never));
  EXPECT_EQ(Enter(kPlaying).result, Result::kResultOk);
  EXPECT_TRUE(Reaches(Phase::kRunning));
  const base::Status refused = TakeSteps(*simulation_, 1, never);
  ASSERT_FALSE(refused);
  EXPECT_EQ(ResultOf(refused).result, Result::kResultIncorrectState);
}

TEST_F(RunServicesTest, EditsARunningSimulationInAPause) {
  EXPECT_EQ(Enter(kPlaying).result, Result::kResultOk);
  EXPECT_TRUE(Reaches(Phase::kRunning));
  Phase during = Phase::kCreated;
  EXPECT_TRUE(EditWhilePaused(*simulation_, [&]() -> base::Status {
    during = PhaseOf(*simulation_);
    return {};
  }));
  EXPECT_EQ(during, Phase::kPaused);
  EXPECT_TRUE(Reaches(Phase::kRunning));
}

}  // namespace
}  // namespace gsv::ros2
