#include "gsv/hosting/hosted_behaviour.h"

#include <stdexcept>

#include <gmock/gmock.h>

#include "gsv/sensing/devices/built_in.h"
#include "gsv/simulation/testing/test_simulation.h"

namespace gsv::hosting {
namespace {

using simulation::kTimeout;
using simulation::Lockstep;
using simulation::Phase;
using simulation::RunToEnd;
using simulation::Simulation;
using simulation::StatusOf;

// A behaviour that executes a function of the test.
class Scripted final : public Behaviour {
 public:
  using Body = std::function<void(gsv::Robot&, Sonar&)>;
  explicit Scripted(Body body) : body_(std::move(body)) {}

  base::Status Init(gsv::Robot& robot) override {
    auto sonar = robot.OpenSonar("front");
    if (!sonar) return base::Fail(sonar.error());
    sonar_ = *std::move(sonar);
    return {};
  }
  void Run(gsv::Robot& robot) override { body_(robot, *sonar_); }

 private:
  const Body body_;
  std::unique_ptr<Sonar> sonar_;
};

std::shared_ptr<HostedBehaviour> Hosted(Scripted::Body body) {
  return std::make_shared<HostedBehaviour>("scripted",
                                           [body] { return std::make_unique<Scripted>(body); });
}

// Drives towards the wall, and slows down when it is near.
class Approach final : public Controller {
 public:
  Approach() : Controller(50ms) {}
  base::Status Init(gsv::Robot& robot) override { return robot.OpenSensor("front"); }
  DriveCommand Control(const std::vector<Reading>& readings) override {
    return {0.5 * readings.at(0).values.at(0), 0.1};
  }
};

// Drives like Approach, but with explicit waits, on a fibre.
void ApproachInALoop(gsv::Robot& robot, Sonar&) {
  std::vector<Reading> readings;
  DriveCommand command;
  for (SimTime next = robot.Now() + 50ms; robot.Exchange(command, next, readings); next += 50ms) {
    command = {0.5 * readings.at(0).values.at(0), 0.1};
  }
}

std::string HashOfACrowd(
    int robots, int threads,
    const std::function<std::shared_ptr<HostedBehaviour>(int robot)>& behaviour) {
  auto specification = Lockstep(2s);
  specification.threads = threads;
  auto crowd = simulation::Make(specification);
  for (int i = 0; i < robots; ++i) {
    const int column = i % 10, row = i / 10;
    EXPECT_TRUE(crowd->AddRobot(
        simulation::Robot("robot_" + std::to_string(i), -column, 0.5 * row, behaviour(i))));
  }
  EXPECT_EQ(RunToEnd(*crowd), Phase::kFinished);
  EXPECT_GT(StatusOf(*crowd, "robot_0").distance, 0.5);
  return crowd->state_hash();
}

TEST(HostedBehaviour, ReadsSensorsAtTheInstantsOfItsWakes) {
  auto simulation = simulation::Make(Lockstep(200ms));
  std::vector<double> ranges;
  ASSERT_TRUE(simulation->AddRobot(
      simulation::Robot("robot", 0, 0, Hosted([&](gsv::Robot& robot, Sonar& sonar) {
                          do {
                            ranges.push_back(sonar.Range());
                            robot.Drive(1.0, 0);
                          } while (robot.SleepFor(50ms));
                        }))));
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
  // The wall's face is at x = 2.9. At 1 m/s, the range decreases by 0.05 m every 50 ms.
  ASSERT_EQ(ranges.size(), 4u);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(ranges[i], 2.9 - 0.05 * i, 1e-9);
  EXPECT_EQ(StatusOf(*simulation, "robot").readings["sonar"], 4u);
}

TEST(HostedBehaviour, ControllerEqualsTheSameLoopOnAFibre) {
  const auto as_controller = [](int) {
    return std::make_shared<HostedBehaviour>("approach",
                                             [] { return std::make_unique<Approach>(); });
  };
  const auto as_loop = [](int) { return Hosted(ApproachInALoop); };
  EXPECT_EQ(HashOfACrowd(3, 1, as_controller), HashOfACrowd(3, 1, as_loop));
}

// One of the two runs imitates a remote behaviour: it executes the behaviour on a separate thread,
// and makes the calls that the servants make for remote behaviours.
TEST(HostedBehaviour, HasTheSameHashAsTheRemoteBehaviour) {
  auto outside = simulation::Make(Lockstep(2s));
  auto behaviour = std::make_shared<simulation::ThreadBehaviour>(
      [](simulation::Agent& agent, simulation::ClockId clock) {
        ASSERT_TRUE(agent.OpenSensor("front"));
        world::DriveCommand command;
        for (std::uint64_t cycle = 1;; ++cycle) {
          const SimTime until = static_cast<std::int64_t>(cycle) * 50ms;
          base::Result<simulation::Exchanged> exchanged = simulation::Exchanged{};
          while (exchanged && exchanged->wait == simulation::Wait::kNotYet) {
            exchanged = agent.Exchange(clock, cycle, command, until, 100ms);
          }
          if (!exchanged) return;
          command = {0.5 * exchanged->readings.at(0).reading.values.at(0), 0, 0.1};
        }
      });
  ASSERT_TRUE(outside->AddRobot(simulation::Robot("robot_0", 0, 0, behaviour)));
  ASSERT_EQ(RunToEnd(*outside), Phase::kFinished);
  EXPECT_EQ(outside->state_hash(), HashOfACrowd(1, 1, [](int) { return Hosted(ApproachInALoop); }));
}

TEST(HostedBehaviour, HashDoesNotDependOnTheNumberOfThreads) {
  const auto mixed = [](int robot) {
    return robot % 2 == 0 ? Hosted(ApproachInALoop)
                          : std::make_shared<HostedBehaviour>(
                                "approach", [] { return std::make_unique<Approach>(); });
  };
  const std::string hash = HashOfACrowd(60, 1, mixed);
  EXPECT_EQ(HashOfACrowd(60, 2, mixed), hash);
  EXPECT_EQ(HashOfACrowd(60, 7, mixed), hash);
}

TEST(HostedBehaviour, HashOfACrowdDoesNotDependOnTheNumberOfThreads) {
  const auto controller = [](int) {
    return std::make_shared<HostedBehaviour>("approach",
                                             [] { return std::make_unique<Approach>(); });
  };
  EXPECT_EQ(HashOfACrowd(60, 7, controller), HashOfACrowd(60, 1, controller));
}

TEST(HostedBehaviour, ExceptionEndsOneBehaviourAndTheOthersContinue) {
  auto simulation = simulation::Make(Lockstep(500ms));
  ASSERT_TRUE(
      simulation->AddRobot(simulation::Robot("bad", 0, 0, Hosted([](gsv::Robot& robot, Sonar&) {
                                               robot.SleepFor(100ms);
                                               throw std::runtime_error("out of ideas");
                                             }))));
  ASSERT_TRUE(
      simulation->AddRobot(simulation::Robot("good", 0, 1, Hosted([](gsv::Robot& robot, Sonar&) {
                                               robot.Drive(1.0, 0);
                                               while (robot.SleepFor(50ms)) {
                                               }
                                             }))));
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
  EXPECT_NEAR(StatusOf(*simulation, "good").distance, 0.5, 1e-9);
  const auto bad = StatusOf(*simulation, "bad");
  EXPECT_EQ(bad.phase, simulation::AgentPhase::kDead);
  EXPECT_EQ(bad.cause, "out of ideas");
}

TEST(HostedBehaviour, FailureEndsTheRunIfThePolicyRequiresIt) {
  auto specification = Lockstep(500ms);
  specification.on_failure = simulation::FailurePolicy::kFail;
  const auto hash_of = [&](std::shared_ptr<simulation::BehaviourPort> behaviour) {
    auto simulation = simulation::Make(specification);
    EXPECT_TRUE(simulation->AddRobot(simulation::Robot("bad", 0, 0, std::move(behaviour))));
    EXPECT_EQ(RunToEnd(*simulation), Phase::kFailed);
    EXPECT_EQ(simulation->status().time, 100ms);
    EXPECT_THAT(simulation->status().failure, ::testing::HasSubstr("died"));
    return simulation->state_hash();
  };
  const std::string inside = hash_of(Hosted([](gsv::Robot& robot, Sonar&) {
    robot.Drive(1.0, 0);
    robot.SleepFor(100ms);
    throw std::runtime_error("out of ideas");
  }));
  const std::string outside = hash_of(std::make_shared<simulation::ThreadBehaviour>(
      [](simulation::Agent& agent, simulation::ClockId clock) {
        EXPECT_TRUE(agent.OpenSensor("front"));
        EXPECT_TRUE(agent.Command({1.0, 0, 0}));
        EXPECT_TRUE(simulation::SleepFor(agent, clock, 100ms));
        EXPECT_TRUE(agent.GiveUp(clock, "out of ideas"));
      }));
  EXPECT_EQ(inside, outside);
}

TEST(HostedBehaviour, BehaviourThatReturnsHasFinished) {
  auto simulation = simulation::Make(Lockstep(500ms));
  ASSERT_TRUE(simulation->AddRobot(simulation::Robot(
      "robot", 0, 0, Hosted([](gsv::Robot& robot, Sonar&) { robot.SleepFor(100ms); }))));
  ASSERT_TRUE(simulation->RunUntil(300ms));
  ASSERT_EQ(simulation->WaitForPhase({Phase::kPaused}, kTimeout), Phase::kPaused);
  EXPECT_EQ(StatusOf(*simulation, "robot").phase, simulation::AgentPhase::kFinished);
}

TEST(HostedBehaviour, RunAfterAResetEqualsTheFirst) {
  auto simulation = simulation::Make(Lockstep(300ms));
  ASSERT_TRUE(simulation->AddRobot(simulation::Robot("robot", 0, 0, Hosted(ApproachInALoop))));
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
  const std::string first = simulation->state_hash();
  ASSERT_TRUE(simulation->Reset());
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
  EXPECT_EQ(simulation->state_hash(), first);
}

TEST(HostedBehaviour, BehaviourReturnsWhenTheRunIsStopped) {
  std::atomic<bool> has_returned = false;
  auto simulation = simulation::Make(Lockstep(0s));
  ASSERT_TRUE(
      simulation->AddRobot(simulation::Robot("robot", 0, 0, Hosted([&](gsv::Robot& robot, Sonar&) {
                                               while (robot.SleepFor(50ms)) {
                                               }
                                               has_returned = true;
                                               has_returned.notify_all();
                                             }))));
  ASSERT_TRUE(simulation->Start());
  ASSERT_EQ(simulation->WaitForPhase({Phase::kRunning}, kTimeout), Phase::kRunning);
  ASSERT_TRUE(simulation->Stop());
  has_returned.wait(false);
}

TEST(HostedBehaviour, BehaviourThatOnlyWaitsForPastInstantsIsEnded) {
  auto specification = Lockstep(100ms);
  specification.deadline = 50ms;
  auto simulation = simulation::Make(specification);
  ASSERT_TRUE(
      simulation->AddRobot(simulation::Robot("robot", 0, 0, Hosted([](gsv::Robot& robot, Sonar&) {
                                               while (robot.SleepUntil(SimTime(0))) {
                                               }
                                             }))));
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
  EXPECT_EQ(StatusOf(*simulation, "robot").phase, simulation::AgentPhase::kUnresponsive);
}

// A slow sensor, such as a camera. Its reading is the simulated time in milliseconds.
class Slow final : public sensing::Sensor {
 public:
  using Sensor::Sensor;
  base::Result<sensing::Reading> Sample(const sensing::Sampling& sampling) const override {
    sensing::Reading reading = sampling.Stamped();
    reading.values = {static_cast<double>(reading.time / 1ms)};
    return reading;
  }
  bool TakesLong() const override { return true; }
};

// A behaviour that turns in place and opens five sonars, which are read together. The behaviour
// calls `look` in each cycle.
class Sweeper final : public Controller {
 public:
  static constexpr int kSonars = 5;
  using Ranges = std::vector<double>;
  using Look = std::function<void(const Ranges& swept, const Ranges& alone)>;

  explicit Sweeper(Look look) : Controller(50ms), look_(std::move(look)) {}
  base::Status Init(gsv::Robot& robot) override {
    robot_ = &robot;
    for (int i = 0; i < kSonars; ++i) {
      auto sonar =
          robot.CreateSonar("s" + std::to_string(i), {0.1 * i, 0, 0.2, 0, 0, 1.2 * i}, 0.05, 4);
      if (!sonar) return base::Fail(sonar.error());
      sonars_.push_back(*std::move(sonar));
    }
    return {};
  }
  DriveCommand Control(const std::vector<Reading>& readings) override {
    Ranges swept, alone;
    for (int i = 0; i < kSonars; ++i) {
      EXPECT_EQ(readings.at(i).sensor, "s" + std::to_string(i));
      // One of the tests disables the first sensor, so its reading may be older.
      if (i > 0) {
        EXPECT_EQ(readings.at(i).time, robot_->Now());
      }
      swept.push_back(readings.at(i).values.at(0));
      alone.push_back(sonars_[i]->Range());
    }
    look_(swept, alone);
    return {0, 0.5};
  }

 private:
  const Look look_;
  gsv::Robot* robot_ = nullptr;
  std::vector<std::unique_ptr<Sonar>> sonars_;
};

TEST(HostedBehaviour, ReadingManySonarsTogetherEqualsReadingThemOneByOne) {
  auto simulation = simulation::Make(Lockstep(1s));
  int cycles = 0, echoes = 0;
  const auto look = [&](const Sweeper::Ranges& swept, const Sweeper::Ranges& alone) {
    EXPECT_EQ(swept, alone);
    for (const double range : swept) echoes += range < 4;
    // When a viewer reads the same sensor too, the behaviour still gets the same samples.
    if (++cycles == 5) {
      EXPECT_EQ(simulation->Watch("robot", "s2")->values.at(0), swept[2]);
    }
  };
  ASSERT_TRUE(simulation->AddRobot(
      simulation::Robot("robot", 0, 0, std::make_shared<HostedBehaviour>("sweeper", [look] {
                          return std::make_unique<Sweeper>(look);
                        }))));
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
  EXPECT_GT(cycles, 15);
  EXPECT_GT(echoes, 10);
  const auto expected = static_cast<std::uint64_t>(2 * Sweeper::kSonars * cycles);
  EXPECT_EQ(StatusOf(*simulation, "robot").readings["sonar"], expected);
}

// A behaviour that opens sonars of its own and checks that it reads exactly these.
class OwnSonars final : public Controller {
 public:
  OwnSonars(std::string prefix, int count, int* cycles)
      : Controller(50ms), prefix_(std::move(prefix)), count_(count), cycles_(cycles) {}
  base::Status Init(gsv::Robot& robot) override {
    for (int i = 0; i < count_; ++i) {
      auto sonar = robot.CreateSonar(prefix_ + std::to_string(i), {0, 0, 0.2, 0, 0, 1.2 * i}, 0.05,
                                     0.06 * (i + 1));
      if (!sonar) return base::Fail(sonar.error());
    }
    return {};
  }
  DriveCommand Control(const std::vector<Reading>& readings) override {
    EXPECT_EQ(readings.size(), static_cast<std::size_t>(count_));
    for (int i = 0; i < count_; ++i) {
      EXPECT_EQ(readings.at(i).sensor, prefix_ + std::to_string(i));
      EXPECT_EQ(readings.at(i).values, std::vector{0.06 * (i + 1)});  // nothing is in range
    }
    ++*cycles_;
    return {};
  }

 private:
  const std::string prefix_;
  const int count_;
  int* const cycles_;
};

TEST(HostedBehaviour, RobotsWithDifferentSensorsReadTheirOwnSensors) {
  auto specification = Lockstep(1s);
  specification.threads = 1;
  auto simulation = simulation::Make(specification);
  const std::vector<std::pair<std::string, int>> sonars{{"a", 4}, {"a", 5}, {"b", 4}, {"a", 0}};
  std::vector<int> cycles(sonars.size());
  for (std::size_t i = 0; i < sonars.size(); ++i) {
    const auto factory = [&, i] {
      return std::make_unique<OwnSonars>(sonars[i].first, sonars[i].second, &cycles[i]);
    };
    const auto added = simulation->AddRobot(
        simulation::Robot("robot" + std::to_string(i), static_cast<double>(i) - 2, 0,
                          std::make_shared<HostedBehaviour>("own", factory)));
    ASSERT_TRUE(added) << added.error().Sentence();
  }
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
  for (const int each : cycles) EXPECT_GE(each, 19);
}

TEST(HostedBehaviour, SilentSonarAmongManyKeepsItsRange) {
  auto specification = Lockstep(1s);
  scenario::Fault fault;
  fault.kind = scenario::Fault::Kind::kSensorSilent;
  fault.at = 0.49, fault.body = "robot", fault.part = "s0";
  specification.faults.push_back(fault);
  auto simulation = simulation::Make(specification);
  std::vector<double> silent, working;
  const auto look = [&](const Sweeper::Ranges& swept, const Sweeper::Ranges&) {
    silent.push_back(swept[0]);
    working.push_back(swept[1]);
  };
  ASSERT_TRUE(simulation->AddRobot(
      simulation::Robot("robot", 0, 0, std::make_shared<HostedBehaviour>("sweeper", [look] {
                          return std::make_unique<Sweeper>(look);
                        }))));
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
  ASSERT_GT(silent.size(), 15u);
  EXPECT_NE(silent[2], silent[6]);  // before the fault, the values differ
  for (std::size_t i = 11; i < silent.size(); ++i) EXPECT_EQ(silent[i], silent[10]);
}

TEST(HostedBehaviour, SlowSensorIsReadAtTheInstantOfTheRequest) {
  auto sensors = std::make_shared<sensing::SensorRegistry>();
  sensing::AddBuiltInSensors(*sensors);
  sensing::SensorType slow;
  slow.name = "positioning_by_post";
  slow.create = [](const model::SensorDescription& description)
      -> base::Result<std::unique_ptr<sensing::Sensor>> {
    return std::make_unique<Slow>(description);
  };
  ASSERT_TRUE(sensors->Add(std::move(slow)));
  auto simulation = Simulation::Create(Lockstep(200ms), sensors);
  ASSERT_TRUE(simulation);

  auto model = std::make_shared<model::Model>(*simulation::Disc(0.2));
  model->sensors.push_back({.name = "slow", .type = "positioning_by_post"});
  auto robot = simulation::Robot("robot", 0, 0);
  robot.model = model;
  std::vector<double> instants;
  class Reader final : public Behaviour {
   public:
    explicit Reader(std::vector<double>& instants) : instants_(instants) {}
    base::Status Init(gsv::Robot& robot) override { return robot.OpenSensor("slow"); }
    void Run(gsv::Robot& robot) override {
      std::vector<Reading> readings;
      for (SimTime next = 50ms; robot.Exchange({}, next, readings); next += 50ms) {
        instants_.push_back(readings.at(0).values.at(0));
      }
    }

   private:
    std::vector<double>& instants_;
  };
  robot.behaviour = std::make_shared<HostedBehaviour>(
      "reader", [&] { return std::make_unique<Reader>(instants); });
  ASSERT_TRUE((*simulation)->AddRobot(robot));
  ASSERT_EQ(RunToEnd(**simulation), Phase::kFinished);
  EXPECT_EQ(instants, (std::vector{50.0, 100.0, 150.0}));
}

}  // namespace
}  // namespace gsv::hosting
