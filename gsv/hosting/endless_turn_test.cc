// A behaviour in this process cannot be interrupted if it does not return. The tests check that no
// thread waits for such a behaviour.
#include <future>

#include "gsv/hosting/hosted_behaviour.h"
#include "gsv/simulation/testing/test_simulation.h"

namespace gsv::hosting {
namespace {

using simulation::kTimeout;
using simulation::Mode;
using simulation::Phase;
using simulation::RunToEnd;
using simulation::Simulation;
using simulation::StatusOf;

class EndlessBehaviour final : public Behaviour {
 public:
  using Body = std::function<void(gsv::Robot&)>;
  explicit EndlessBehaviour(Body body) : body_(std::move(body)) {}
  void Run(gsv::Robot& robot) override { body_(robot); }

 private:
  const Body body_;
};

std::shared_ptr<HostedBehaviour> HostedEndless(const std::string& name,
                                               EndlessBehaviour::Body body) {
  return std::make_shared<HostedBehaviour>(
      name, [body] { return std::make_unique<EndlessBehaviour>(body); });
}

void Wait(gsv::Robot& robot) {
  while (robot.SleepFor(50ms)) {
  }
}

// A simulation with 40 robots, of which robot_20 runs the test's behaviour. The other robots only
// wait. The test decides when a turn of robot_20 ends.
class EndlessTurn : public ::testing::TestWithParam<Mode> {
 public:
  EndlessTurn() {
    auto specification = simulation::Lockstep(300ms);
    specification.mode = GetParam();
    specification.deadline = 300ms;
    specification.threads = 2;
    simulation_ = simulation::Make(specification);
  }
  ~EndlessTurn() override {
    Release();
    simulation_.reset();
    const auto ended = end_.get_future();
    token_.reset();
    EXPECT_EQ(ended.wait_for(kTimeout), std::future_status::ready) << "it was never destroyed";
  }

 protected:
  void AddRobots(const EndlessBehaviour::Body& body) {
    for (int i = 0; i < 40; ++i) {  // enough robots that several threads execute turns
      const std::string name = "robot_" + std::to_string(i);
      const int column = i % 10, row = i / 10;
      auto behaviour = HostedEndless("patient", Wait);
      // The behaviour holds the token. The fixture's destructor uses the token to check that the
      // behaviour is destroyed.
      if (i == 20)
        behaviour = HostedEndless("endless", [body, held = token_](auto& r) { body(r); });
      ASSERT_TRUE(
          simulation_->AddRobot(simulation::Robot(name, -column, 0.5 * row, std::move(behaviour))));
    }
  }
  void AwaitRelease() { released_.wait(false); }
  void Release() {
    released_ = true;
    released_.notify_all();
  }
  // Waits until robot_20 is in an endless turn, and the simulation has noticed.
  void GetStuck() {
    AddRobots([this](gsv::Robot& robot) {
      robot.SleepFor(100ms);
      AwaitRelease();
      Wait(robot);
    });
    ASSERT_EQ(RunToEnd(*simulation_), Phase::kFailed);
  }

  std::shared_ptr<Simulation> simulation_;

 private:
  std::atomic<bool> released_ = false;
  std::promise<void> end_;
  std::shared_ptr<void> token_{nullptr, [this](void*) { end_.set_value(); }};
};

INSTANTIATE_TEST_SUITE_P(Modes, EndlessTurn, ::testing::Values(Mode::kLockstep, Mode::kRealTime),
                         [](const auto& mode) {
                           return mode.param == Mode::kLockstep ? "Lockstep" : "RealTime";
                         });

TEST_P(EndlessTurn, FailsTheSimulationAndNamesTheBehaviour) {
  GetStuck();
  EXPECT_EQ(simulation_->status().failure,
            "robot_20 (endless) has not returned from its turn within 300 ms; an "
            "in-process behaviour cannot be interrupted, so run it as a separate program, without "
            "--in-process");
  EXPECT_EQ(StatusOf(*simulation_, "robot_20").phase, simulation::AgentPhase::kUnresponsive);
  EXPECT_NE(StatusOf(*simulation_, "robot_19").phase, simulation::AgentPhase::kUnresponsive);
  int events = 0;
  for (const simulation::Event& event : simulation_->events(0)) {
    events += event.kind == "agent_unresponsive" && event.robot == "robot_20";
  }
  EXPECT_EQ(events, 1);
}

TEST_P(EndlessTurn, RequestsThatNeedTheWorldAreRefused) {
  GetStuck();
  EXPECT_EQ(simulation_->state_hash(), "");
  const auto added = simulation_->AddRobot(simulation::Robot("late", 1, 3));
  ASSERT_FALSE(added);
  EXPECT_EQ(added.error().code, base::ErrorCode::kEnded);
  EXPECT_FALSE(simulation_->RemoveRobot("robot_1"));
  EXPECT_FALSE(simulation_->RemoveRobot("robot_20"));
  EXPECT_FALSE(simulation_->Reset());
  EXPECT_TRUE(simulation_->Stop());
  EXPECT_EQ(simulation_->snapshot()->state.time, 100ms);
}

// A reset that was requested before the simulation got stuck is refused as well.
TEST_P(EndlessTurn, WaitingResetIsRefused) {
  std::promise<void> entered;
  AddRobots([&](gsv::Robot& robot) {
    robot.SleepFor(100ms);
    entered.set_value();
    AwaitRelease();
    Wait(robot);
  });
  ASSERT_TRUE(simulation_->Start());
  entered.get_future().wait();
  EXPECT_FALSE(simulation_->Reset());
}

TEST_P(EndlessTurn, SimulationIsAbandonedWhenDestroyed) {
  GetStuck();
  const int before = Simulation::AbandonedSimulations();
  simulation_.reset();
  EXPECT_EQ(Simulation::AbandonedSimulations(), before + 1);
}

TEST_P(EndlessTurn, AfterALateEndTheSimulationCanBeReset) {
  GetStuck();
  Release();
  const auto give_up = std::chrono::steady_clock::now() + kTimeout;
  while (!simulation_->Reset() && std::chrono::steady_clock::now() < give_up) {
  }
  EXPECT_EQ(RunToEnd(*simulation_), Phase::kFinished);
  EXPECT_EQ(simulation_->status().failure, "");
}

TEST_P(EndlessTurn, BehaviourThatIgnoresItsEndIsAbandoned) {
  AddRobots([this](gsv::Robot& robot) {
    robot.SleepFor(1h);
    AwaitRelease();
  });
  ASSERT_EQ(RunToEnd(*simulation_), Phase::kFinished);
  EXPECT_EQ(simulation_->state_hash().size(), 16u);
  EXPECT_FALSE(simulation_->Reset());
  const int before = Simulation::AbandonedSimulations();
  simulation_.reset();
  EXPECT_EQ(Simulation::AbandonedSimulations(), before + 1);
}

}  // namespace
}  // namespace gsv::hosting
