#include "gsv/simulation/simulation.h"

#include <gmock/gmock.h>

#include "gsv/simulation/testing/test_simulation.h"

namespace gsv::simulation {
namespace {

TEST(Simulation, ACommandIsAppliedFromItsInstantOn) {
  auto simulation = Make(Lockstep(1s));
  ASSERT_TRUE(simulation->AddRobot(Robot("robot", 0, 0, Drives(0.5))));
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
  EXPECT_EQ(simulation->status().step, 100);
  // The command applies from t = 0, without a limit on acceleration. So the robot drives at 0.5 m/s
  // for a whole second.
  EXPECT_NEAR(StatusOf(*simulation, "robot").world_from_robot.position.x, 0.5, 1e-9);
}

TEST(Simulation, TheHashDoesNotDependOnHowSlowABehaviourIs) {
  std::vector<std::string> hashes;
  for (const auto dawdling : {0us, 300us, 0us}) {
    auto simulation = Make(Lockstep(500ms));
    ASSERT_TRUE(simulation->AddRobot(Robot("a", 0, 0, Drives(0.5, dawdling))));
    ASSERT_TRUE(simulation->AddRobot(Robot("b", 0, 1, Drives(0.3, 400us - dawdling))));
    ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
    hashes.push_back(simulation->state_hash());
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_EQ(hashes[0], hashes[2]);
}

TEST(Simulation, TheOrderInWhichRobotsAreAddedDoesNotMatter) {
  std::vector<std::string> hashes;
  for (const bool reversed : {false, true}) {
    auto simulation = Make(Lockstep(300ms));
    std::vector<RobotSpecification> robots{Robot("a", 0, 0, Drives(0.5)),
                                           Robot("b", 0, 1, Drives(0.3))};
    if (reversed) std::swap(robots[0], robots[1]);
    for (auto& robot : robots) ASSERT_TRUE(simulation->AddRobot(std::move(robot)));
    ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
    hashes.push_back(simulation->state_hash());
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

TEST(Simulation, ARunAfterAResetEqualsTheFirst) {
  auto simulation = Make(Lockstep(300ms));
  auto behaviour = Drives(0.5);
  ASSERT_TRUE(simulation->AddRobot(Robot("robot", 0, 0, behaviour)));
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
  const std::string first = simulation->state_hash();
  ASSERT_TRUE(simulation->Reset());
  EXPECT_EQ(simulation->status().phase, Phase::kCreated);
  EXPECT_EQ(simulation->status().step, 0);
  EXPECT_EQ(behaviour->inits, 2);
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
  EXPECT_EQ(simulation->state_hash(), first);
}

TEST(Simulation, AReadingIsAFunctionOfTheInstantForBehaviourAndViewer) {
  auto simulation = Make(Lockstep(200ms));
  std::vector<double> ranges;
  auto behaviour = std::make_shared<ThreadBehaviour>([&](Agent& agent, ClockId clock) {
    do {
      const auto reading = agent.Read("front");
      ASSERT_TRUE(reading) << reading.error().Sentence();
      ranges.push_back(reading->values.at(0));
      (void)agent.Command({1.0, 0, 0});
    } while (SleepFor(agent, clock, 50ms));
  });
  ASSERT_TRUE(simulation->AddRobot(Robot("robot", 0, 0, behaviour)));
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
  // The wall's face is at x = 2.9. At 1 m/s, the range decreases by 0.05 m every 50 ms.
  ASSERT_EQ(ranges.size(), 4u);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(ranges[i], 2.9 - 0.05 * i, 1e-9);
  const auto watched = simulation->Watch("robot", "front");
  ASSERT_TRUE(watched);
  EXPECT_NEAR(watched->values.at(0), 2.7, 1e-9);
  EXPECT_EQ(StatusOf(*simulation, "robot").readings["sonar"], 4u);
}

TEST(Simulation, ExchangeReturnsReadingsAtItsInstantAndCommandsOnce) {
  auto simulation = Make(Lockstep(200ms));
  std::vector<double> ranges;
  auto behaviour = std::make_shared<ThreadBehaviour>([&](Agent& agent, ClockId clock) {
    ASSERT_TRUE(agent.OpenSensor("front"));
    for (std::uint64_t cycle = 1;; ++cycle) {
      const SimTime until = static_cast<std::int64_t>(cycle) * 50ms;
      // With a short lease, calls are certain to be repeated with the same cycle number.
      base::Result<Exchanged> exchanged = Exchanged{};
      while (exchanged && exchanged->wait == Wait::kNotYet) {
        exchanged = agent.Exchange(clock, cycle, world::DriveCommand{1.0, 0, 0}, until, 1ms);
      }
      if (!exchanged) return;
      ASSERT_EQ(exchanged->readings.size(), 1u);
      EXPECT_EQ(exchanged->now, until);
      ranges.push_back(exchanged->readings[0].reading.values.at(0));
    }
  });
  ASSERT_TRUE(simulation->AddRobot(Robot("robot", 0, 0, behaviour)));
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
  ASSERT_EQ(ranges.size(), 3u);  // no agent is woken at the final instant
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(ranges[i], 2.85 - 0.05 * i, 1e-9);
}

// A behaviour that only waits, for one hour of simulated time in each call.
std::shared_ptr<ThreadBehaviour> Sleeps() {
  return std::make_shared<ThreadBehaviour>([](Agent& agent, ClockId clock) {
    while (SleepFor(agent, clock, 1h)) {
    }
  });
}

// Counts the steps.
class StepCounter final : public Observer {
 public:
  void OnSnapshot(const std::shared_ptr<const world::Snapshot>&) override {
    ++steps;
    steps.notify_all();
  }
  void OnEvent(const Event&) override {}

  std::atomic<int> steps = 0;
};

TEST(Simulation, WaitingAgentMayNeitherCommandNorReadInLockstep) {
  auto simulation = Make(Lockstep(0s));
  const auto counter = std::make_shared<StepCounter>();
  simulation->AddObserver(counter);
  ASSERT_TRUE(simulation->AddRobot(Robot("robot", 0, 0, Sleeps())));
  ASSERT_TRUE(simulation->Start());
  counter->steps.wait(0);  // the agent runs, so no step is taken
  auto agent = simulation->agent("robot");
  const auto command = agent->Command({1, 0, 0});
  ASSERT_FALSE(command);
  EXPECT_EQ(command.error().code, base::ErrorCode::kNotRunning);
  const auto reading = agent->Read("front");
  ASSERT_FALSE(reading);
  EXPECT_EQ(reading.error().code, base::ErrorCode::kNotRunning);
  EXPECT_EQ(simulation->status().phase, Phase::kRunning);
  const int steps = counter->steps;
  counter->steps.wait(steps);
  EXPECT_EQ(StatusOf(*simulation, "robot").distance, 0.0);
}

TEST(Simulation, AWaitingAgentsCommandIsRefusedInAPause) {
  auto simulation = Make(Lockstep(0s));
  ASSERT_TRUE(simulation->AddRobot(Robot("robot", 0, 0, Sleeps())));
  ASSERT_TRUE(simulation->RunUntil(100ms));
  ASSERT_EQ(simulation->WaitForPhase({Phase::kPaused}, kTimeout), Phase::kPaused);
  EXPECT_EQ(simulation->status().time, SimTime(100ms));
  const auto command = simulation->agent("robot")->Command({1, 0, 0});
  ASSERT_FALSE(command);
  EXPECT_EQ(command.error().code, base::ErrorCode::kNotRunning);
}

TEST(Simulation, AfterTheEndOfTheRunAgentsCallsEnd) {
  auto simulation = Make(Lockstep(100ms));
  ASSERT_TRUE(simulation->AddRobot(Robot("robot", 0, 0, Sleeps())));
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
  const auto command = simulation->agent("robot")->Command({1, 0, 0});
  ASSERT_FALSE(command);
  EXPECT_EQ(command.error().code, base::ErrorCode::kEnded);
}

// Regression: a behaviour must repeat its wait when the lease of the wait ends. If the wait was for
// the instant of a pause and was repeated during this pause, it ended at once. This changed the
// state hash.
TEST(Simulation, AWaitForTheInstantOfAPauseEndsWithTheResume) {
  auto simulation = Make(Lockstep(0s));
  std::atomic<int> leases = 0;
  std::atomic<bool> has_reached = false;
  auto behaviour = std::make_shared<ThreadBehaviour>([&](Agent& agent, ClockId clock) {
    for (base::Result<Wait> wait = Wait::kNotYet; wait && *wait == Wait::kNotYet;) {
      wait = agent.SleepUntil(clock, 100ms, 1ms);
      has_reached = wait && *wait == Wait::kReached;
      ++leases;
      leases.notify_all();
    }
    while (SleepFor(agent, clock, 1h)) {
    }
  });
  ASSERT_TRUE(simulation->AddRobot(Robot("robot", 0, 0, behaviour)));
  ASSERT_TRUE(simulation->RunUntil(100ms));
  ASSERT_EQ(simulation->WaitForPhase({Phase::kPaused}, kTimeout), Phase::kPaused);
  const std::string hash = simulation->state_hash();
  for (int i = 0; i < 3; ++i) {
    const int ended = leases;
    if (!has_reached) leases.wait(ended);
  }
  EXPECT_FALSE(has_reached);
  EXPECT_EQ(simulation->state_hash(), hash);
  ASSERT_TRUE(simulation->Step(1));
  ASSERT_EQ(simulation->WaitForPhase({Phase::kPaused}, kTimeout), Phase::kPaused);
  EXPECT_TRUE(has_reached);
}

TEST(Simulation, PauseStopsTheClockAndNotifiesTheBehaviours) {
  auto simulation = Make(Lockstep(0s));
  std::atomic<int> waits = 0;
  auto behaviour = std::make_shared<ThreadBehaviour>([&](Agent& agent, ClockId clock) {
    SimTime until = 10ms;
    for (;;) {
      const auto wait = agent.SleepUntil(clock, until, 1ms);
      if (!wait) return;
      if (*wait == Wait::kReached) until += 10ms;
      ++waits;
      waits.notify_all();
    }
  });
  ASSERT_TRUE(simulation->AddRobot(Robot("robot", 0, 0, behaviour)));
  ASSERT_TRUE(simulation->Start());
  ASSERT_EQ(simulation->WaitForPhase({Phase::kRunning}, kTimeout), Phase::kRunning);
  ASSERT_TRUE(simulation->Pause());
  (void)simulation->state_hash();  // waits until the step in progress has ended
  const std::int64_t step = simulation->status().step;
  // During the pause, each wait ends with its lease. If the simulation still ran, its steps would
  // end the waits, and the number of steps would change.
  for (int i = 0; i < 5; ++i) waits.wait(waits);
  EXPECT_EQ(simulation->status().step, step);
  ASSERT_TRUE(simulation->Step(7));
  ASSERT_EQ(simulation->WaitForPhase({Phase::kPaused}, kTimeout), Phase::kPaused);
  EXPECT_EQ(simulation->status().step, step + 7);
  ASSERT_TRUE(simulation->Resume());
  ASSERT_TRUE(simulation->Stop());
  EXPECT_EQ(simulation->status().phase, Phase::kStopped);
  simulation.reset();
  EXPECT_EQ(behaviour->stops, 1);
  EXPECT_EQ(behaviour->pauses, 1);
  EXPECT_EQ(behaviour->resumes, 1);
}

TEST(Simulation, ActionsThatThePhaseDoesNotAllowAreRefusedWithASentence) {
  auto simulation = Make(Lockstep(0s));
  const auto resumed = simulation->Resume();
  ASSERT_FALSE(resumed);
  EXPECT_EQ(resumed.error().code, base::ErrorCode::kNotRunning);
  EXPECT_NE(resumed.error().message.find("paused"), std::string::npos);
  ASSERT_TRUE(simulation->Stop());
  EXPECT_FALSE(simulation->Start());
  EXPECT_FALSE(simulation->Step(1));
}

TEST(Simulation, ABehaviourThatNeverWaitsIsDeclaredUnresponsiveAndTheRunContinues) {
  Specification specification = Lockstep(200ms);
  specification.deadline = 500ms;  // long enough for a correct behaviour on a busy machine
  auto simulation = Make(specification);
  std::atomic<bool> release = false;
  auto stuck = std::make_shared<ThreadBehaviour>([&](Agent& agent, ClockId) {
    (void)agent.Command({1.0, 0, 0});
    release.wait(false);
  });
  ASSERT_TRUE(simulation->AddRobot(Robot("stuck", 0, 0, stuck)));
  ASSERT_TRUE(simulation->AddRobot(Robot("good", 0, 1, Drives(1.0))));
  ASSERT_TRUE(simulation->Start());
  EXPECT_EQ(simulation->WaitForPhase({Phase::kFinished}, kTimeout), Phase::kFinished);
  EXPECT_EQ(StatusOf(*simulation, "stuck").phase, AgentPhase::kUnresponsive);
  // the robot of the unresponsive behaviour stops
  EXPECT_EQ(StatusOf(*simulation, "stuck").distance, 0.0);
  EXPECT_NEAR(StatusOf(*simulation, "good").distance, 0.2, 1e-9);
  release = true;
  release.notify_all();
}

TEST(Simulation, BehaviourThatGivesUpIsDeadAndItsReasonIsOneLine) {
  auto simulation = Make(Lockstep(500ms));
  const auto quitter = std::make_shared<ThreadBehaviour>([](Agent& agent, ClockId clock) {
    EXPECT_TRUE(agent.Command({1.0, 0, 0}));
    EXPECT_TRUE(SleepFor(agent, clock, 100ms));
    EXPECT_TRUE(agent.GiveUp(clock, "no\nidea" + std::string(1'000'000, '!')));
    (void)agent.GiveUp(clock, "once more");
  });
  ASSERT_TRUE(simulation->AddRobot(Robot("quitter", 0, 0, quitter)));
  ASSERT_TRUE(simulation->AddRobot(Robot("other", 0, 1, Drives(1.0))));
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
  const RobotStatus status = StatusOf(*simulation, "quitter");
  EXPECT_EQ(status.phase, AgentPhase::kDead);
  EXPECT_NEAR(status.distance, 0.1, 1e-9);  // the robot did not move after that
  EXPECT_NEAR(StatusOf(*simulation, "other").distance, 0.5, 1e-9);
  EXPECT_THAT(status.detail, ::testing::HasSubstr("its run ended with an error: no\\nidea!!!"));
  EXPECT_LT(status.detail.size(), 1200u);
  EXPECT_EQ(status.detail, "its run ended with an error: " + status.cause);
  std::vector<std::string> told;
  for (const Event& event : simulation->events(0)) {
    if (event.kind == "agent_dead") told.push_back(event.detail);
  }
  EXPECT_EQ(told, std::vector<std::string>{"quitter (test): " + status.detail});
}

TEST(Simulation, ADeadBehaviourEndsTheRunIfThePolicyRequiresIt) {
  Specification specification = Lockstep(0s);
  specification.on_failure = FailurePolicy::kFail;
  auto simulation = Make(specification);
  auto behaviour = Drives(0.001);
  ASSERT_TRUE(simulation->AddRobot(Robot("robot", 0, 0, behaviour)));
  ASSERT_TRUE(simulation->Start());
  behaviour->dead = true;
  EXPECT_EQ(simulation->WaitForPhase({Phase::kFailed}, kTimeout), Phase::kFailed);
  EXPECT_NE(simulation->status().failure.find("the behaviour of robot (test) died"),
            std::string::npos);
}

TEST(Simulation, RobotsCannotBePlacedInsideEachOtherOrAWall) {
  auto simulation = Make(Lockstep(0s));
  ASSERT_TRUE(simulation->AddRobot(Robot("first", 0, 0)));
  const auto second = simulation->AddRobot(Robot("second", 0.1, 0));
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, base::ErrorCode::kBadModel);
  EXPECT_NE(second.error().Sentence().find("first"), std::string::npos);
  const auto third = simulation->AddRobot(Robot("third", 3.0, 0));
  ASSERT_FALSE(third);
  EXPECT_NE(third.error().Sentence().find("wall"), std::string::npos);
  EXPECT_EQ(simulation->status().robots.size(), 1u);
  EXPECT_TRUE(simulation->AddRobot(Robot("second", 1, 0)));
}

TEST(Simulation, ARobotWhoseBehaviourFailsInInitIsNotAdded) {
  auto simulation = Make(Lockstep(0s));
  auto behaviour = Drives(1);
  behaviour->init_error = base::Error{base::ErrorCode::kBehaviour, "threw in init", "test"};
  const auto added = simulation->AddRobot(Robot("robot", 0, 0, behaviour));
  ASSERT_FALSE(added);
  EXPECT_EQ(added.error().message, "threw in init");
  EXPECT_TRUE(simulation->status().robots.empty());
}

TEST(Simulation, ARobotWithoutANameIsNumberedAfterItsModel) {
  auto simulation = Make(Lockstep(0s));
  EXPECT_EQ(simulation->AddRobot(Robot("", 0, 0)).value_or(""), "disc");
  EXPECT_EQ(simulation->AddRobot(Robot("", 1, 0)).value_or(""), "disc_2");
}

TEST(Simulation, ABehaviourOnTheWallClockIsRefusedInLockstep) {
  auto simulation = Make(Lockstep(0s));
  auto behaviour = std::make_shared<ThreadBehaviour>([](Agent&, ClockId) {}, false);
  EXPECT_FALSE(simulation->AddRobot(Robot("robot", 0, 0, behaviour)));
  RobotSpecification insists = Robot("robot", 0, 0, behaviour);
  insists.allow_unmanaged = true;
  EXPECT_TRUE(simulation->AddRobot(std::move(insists)));
}

TEST(Simulation, RemovingARobotEndsItsBehavioursCalls) {
  auto simulation = Make(Lockstep(0s));
  auto behaviour = Drives(0.01);
  ASSERT_TRUE(simulation->AddRobot(Robot("robot", 0, 0, behaviour)));
  ASSERT_TRUE(simulation->Start());
  ASSERT_EQ(simulation->WaitForPhase({Phase::kRunning}, kTimeout), Phase::kRunning);
  ASSERT_TRUE(simulation->RemoveRobot("robot"));
  EXPECT_TRUE(simulation->status().robots.empty());
  EXPECT_FALSE(simulation->RemoveRobot("robot"));
  simulation.reset();
  EXPECT_GE(behaviour->stops, 1);
}

TEST(Simulation, InRealTimeTheSimulationDoesNotWaitForBehaviours) {
  Specification specification = Lockstep(100ms);
  specification.mode = Mode::kRealTime;
  specification.factor = 10;
  auto simulation = Make(specification);
  std::atomic<bool> release = false;
  auto stuck = std::make_shared<ThreadBehaviour>([&](Agent&, ClockId) { release.wait(false); });
  ASSERT_TRUE(simulation->AddRobot(Robot("robot", 0, 0, stuck)));
  ASSERT_TRUE(simulation->Start());
  EXPECT_EQ(simulation->WaitForPhase({Phase::kFinished}, kTimeout), Phase::kFinished);
  release = true;
  release.notify_all();
}

TEST(Simulation, AnAvatarIsSteeredWithoutABehaviour) {
  auto simulation = Make(Lockstep(1s));
  RobotSpecification person = Robot("person", 0, 0);
  person.is_avatar = true;
  ASSERT_TRUE(simulation->AddRobot(std::move(person)));
  ASSERT_TRUE(simulation->agent("person")->Command({0.5, 0, 0}));
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
  EXPECT_NEAR(StatusOf(*simulation, "person").distance, 0.5, 1e-9);
  EXPECT_TRUE(StatusOf(*simulation, "person").is_avatar);
}

TEST(Simulation, ResumeDuringRequestedStepsContinuesBeyondThem) {
  auto simulation = Make(Lockstep(0s));
  std::atomic<bool> release = false;
  auto slow = std::make_shared<ThreadBehaviour>([&](Agent& agent, ClockId clock) {
    release.wait(false);  // the requested steps end only after the simulation is resumed
    while (SleepFor(agent, clock, 10ms)) {
    }
  });
  ASSERT_TRUE(simulation->AddRobot(Robot("robot", 0, 0, slow)));
  ASSERT_TRUE(simulation->Step(1));
  ASSERT_EQ(simulation->WaitForPhase({Phase::kRunning}, kTimeout), Phase::kRunning);
  ASSERT_TRUE(simulation->Resume());
  release = true;
  release.notify_all();
  while (simulation->status().step < 5) std::this_thread::yield();
  EXPECT_EQ(simulation->status().phase, Phase::kRunning);
}

// Regression: if a run was paused at its end and then resumed, it took one step too many.
TEST(Simulation, RunPausedDuringItsLastStepTakesNoFurtherStep) {
  auto simulation = Make(Lockstep(20ms));
  // With 400 robots, a step takes so long that some of the pauses usually come during the last
  // step.
  for (int i = 0; i < 400; ++i) {
    const int row = i / 20;
    ASSERT_TRUE(simulation->AddRobot(Robot("", -1 - row, i % 20)));
  }
  for (int round = 0; round < 20; ++round) {
    ASSERT_TRUE(simulation->Start());
    while (simulation->snapshot()->state.step == 0) std::this_thread::yield();
    // waits until the step in progress has ended
    if (simulation->Pause()) (void)simulation->state_hash();
    (void)simulation->Resume();  // refused if the run is over
    ASSERT_EQ(simulation->WaitForPhase({Phase::kFinished}, kTimeout), Phase::kFinished);
    ASSERT_EQ(simulation->status().step, 2) << "round " << round;
    ASSERT_TRUE(simulation->Reset());
  }
}

TEST(Simulation, ASonarIsMountedAtAPose) {
  auto simulation = Make(Lockstep(0s));
  ASSERT_TRUE(simulation->AddRobot(Robot("robot", 0, 0)));
  auto agent = simulation->agent("robot");
  model::SensorDescription sonar;
  sonar.name = "ahead";
  sonar.type = "sonar";
  sonar.link_from_sensor = PlanarPose(0.5, 0, 0.3, 0);
  sonar.parameters = {{"min", 0.1}, {"max", 4.0}};
  ASSERT_TRUE(agent->CreateSensor(sonar));
  // The wall's face is at x = 2.9.
  EXPECT_NEAR(agent->Read("ahead")->values.at(0), 2.4, 1e-9);
  EXPECT_FALSE(agent->CreateSensor(sonar));  // this name is taken
  sonar.name = "on a link that does not exist";
  sonar.link = 7;
  EXPECT_FALSE(agent->CreateSensor(sonar));
  EXPECT_TRUE(agent->CloseSensor("ahead"));
  EXPECT_FALSE(agent->Read("ahead"));
}

TEST(Simulation, ARobotReadsItsPose) {
  auto simulation = Make(Lockstep(0s));
  RobotSpecification robot = Robot("robot", 1, -2);
  robot.world_from_robot = PlanarPose(1, -2, 0, 0.5);
  ASSERT_TRUE(simulation->AddRobot(std::move(robot)));
  model::SensorDescription positioning;
  positioning.name = "where";
  positioning.type = "positioning";
  ASSERT_TRUE(simulation->agent("robot")->CreateSensor(positioning));
  const auto reading = simulation->agent("robot")->Read("where");
  ASSERT_TRUE(reading);
  EXPECT_NEAR(reading->values.at(0), 1.0, 1e-12);
  EXPECT_NEAR(reading->values.at(1), -2.0, 1e-12);
  EXPECT_NEAR(reading->values.at(5), 0.5, 1e-12);
}

TEST(Simulation, RobotsAppearInEachOthersSonars) {
  auto simulation = Make(Lockstep(0s));
  ASSERT_TRUE(simulation->AddRobot(Robot("behind", 0, 0)));
  ASSERT_TRUE(simulation->AddRobot(Robot("ahead", 1.5, 0)));
  // The robot ahead is a disc with a radius of 0.2 m.
  EXPECT_NEAR(simulation->agent("behind")->Read("front")->values.at(0), 1.3, 1e-9);
}

TEST(Simulation, ARobotThatTouchesAWallStartsBesideItWithAnEvent) {
  auto simulation = Make(Lockstep(0s));
  ASSERT_TRUE(simulation->AddRobot(Robot("robot", 2.85, 0)));  // the wall's face is at x = 2.9
  const auto status = StatusOf(*simulation, "robot");
  EXPECT_LE(status.world_from_robot.position.x, 2.7 + 1e-3);
  EXPECT_GE(status.world_from_robot.position.x, 2.68);
  const auto events = simulation->events(0);
  EXPECT_EQ(events.front().kind, "robot_moved");
  EXPECT_NE(events.front().detail.find("wall"), std::string::npos);
}

// A sensor that measures the heading. Only this test defines its type.
class Compass final : public sensing::Sensor {
 public:
  using Sensor::Sensor;
  base::Result<sensing::Reading> Sample(const sensing::Sampling& sampling) const override {
    sensing::Reading reading = sampling.Stamped();
    reading.values = {geometry::Yaw(sampling.WorldFromSensor(description()).orientation)};
    return reading;
  }
};

TEST(Simulation, SensorTypeCanBeDefinedOutsideTheLibrary) {
  auto sensors = std::make_shared<sensing::SensorRegistry>();
  sensing::SensorType compass;
  compass.name = "compass";
  compass.create =
      [](const model::SensorDescription& d) -> base::Result<std::unique_ptr<sensing::Sensor>> {
    return std::make_unique<Compass>(d);
  };
  ASSERT_TRUE(sensors->Add(compass));
  auto simulation = *Simulation::Create(Lockstep(0s), sensors);
  RobotSpecification robot = Robot("robot", 0, 0);
  robot.world_from_robot = PlanarPose(0, 0, 0, 0.75);
  ASSERT_TRUE(simulation->AddRobot(std::move(robot)));
  model::SensorDescription description;
  description.name = "heading";
  description.type = "compass";
  ASSERT_TRUE(simulation->agent("robot")->CreateSensor(description));
  EXPECT_NEAR(simulation->agent("robot")->Read("heading")->values.at(0), 0.75, 1e-12);
}

}  // namespace
}  // namespace gsv::simulation
