#include "sdk/cycle_client.h"

#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "gsv/simulation/testing/test_simulation.h"

namespace gsv::simulation {
namespace {

using sdk::CycleClient;
using Outcome = CycleClient::Outcome;

std::unique_ptr<CycleClient> OpenMemory(Agent& agent, ClockId clock) {
  const auto memory = agent.ShareMemory(clock);
  EXPECT_TRUE(memory) << memory.error().Sentence();
  if (!memory) return nullptr;
  auto client = CycleClient::Open(memory->file, memory->offset, memory->key);
  EXPECT_TRUE(client) << client.error().Sentence();
  return client ? *std::move(client) : nullptr;
}

exchange::CycleRequest Exchange(std::uint64_t cycle, double linear, SimTime until) {
  return {cycle, until.count(), linear, 0, 0, 1, 0};
}

// The results of a run in which a robot drives at 1 m/s: its sonar ranges and the state hash.
struct Course {
  std::vector<double> ranges;
  std::string hash;
};

Course DriveByCalls() {
  Course course;
  auto simulation = Make(Lockstep(200ms));
  auto behaviour = std::make_shared<ThreadBehaviour>([&](Agent& agent, ClockId clock) {
    ASSERT_TRUE(agent.OpenSensor("front"));
    for (std::uint64_t cycle = 1;; ++cycle) {
      const SimTime until = static_cast<std::int64_t>(cycle) * 50ms;
      const auto exchanged =
          agent.Exchange(clock, cycle, world::DriveCommand{1.0, 0, 0}, until, kTimeout);
      if (!exchanged) return;
      course.ranges.push_back(exchanged->readings.at(0).reading.values.at(0));
    }
  });
  EXPECT_TRUE(simulation->AddRobot(Robot("robot", 0, 0, behaviour)));
  EXPECT_EQ(RunToEnd(*simulation), Phase::kFinished);
  course.hash = simulation->state_hash();
  return course;
}

TEST(CycleClient, ExchangesAreThoseOfCalls) {
  const Course expected = DriveByCalls();
  Course course;
  auto simulation = Make(Lockstep(200ms));
  auto behaviour = std::make_shared<ThreadBehaviour>([&](Agent& agent, ClockId clock) {
    ASSERT_TRUE(agent.OpenSensor("front"));
    const auto client = OpenMemory(agent, clock);
    ASSERT_NE(client, nullptr);
    CycleClient::Answer answer;
    for (std::uint64_t cycle = 1;; ++cycle) {
      const SimTime until = static_cast<std::int64_t>(cycle) * 50ms;
      if (client->Run(Exchange(cycle, 1.0, until), {}, answer) != Outcome::kAnswered) break;
      EXPECT_EQ(answer.reached, until);
      ASSERT_EQ(answer.readings.size(), 1u);
      EXPECT_EQ(answer.readings[0].sensor, "front");
      EXPECT_EQ(answer.readings[0].time, until);
      course.ranges.push_back(answer.readings[0].values.at(0));
    }
    EXPECT_TRUE(client->is_closed());  // the run is over
  });
  ASSERT_TRUE(simulation->AddRobot(Robot("robot", 0, 0, behaviour)));
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
  EXPECT_EQ(course.ranges, expected.ranges);
  EXPECT_EQ(course.ranges.size(), 3u);  // no agent is woken at the final instant
  EXPECT_EQ(simulation->state_hash(), expected.hash);
  EXPECT_EQ(StatusOf(*simulation, "robot").readings["sonar"], 3u);
}

// Some of the twelve robots use calls. If more than eight robots wait for the same instant, the
// simulation wakes them on another thread (event_signaler.h), so the test has twelve.
TEST(CycleClient, CallsAndMemoryMayBeMixed) {
  std::vector<std::string> hashes;
  for (const int with_memory : {0, 5, 12}) {
    auto simulation = Make(Lockstep(500ms));
    for (int robot = 0; robot < 12; ++robot) {
      auto behaviour = std::make_shared<ThreadBehaviour>([=](Agent& agent, ClockId clock) {
        const auto client = robot < with_memory ? OpenMemory(agent, clock) : nullptr;
        CycleClient::Answer answer;
        for (std::uint64_t cycle = 1;; ++cycle) {
          const SimTime until = static_cast<std::int64_t>(cycle) * 30ms;
          const double speed = 0.1 + 0.01 * robot;
          // Every third robot uses calls and memory alternately.
          if (client != nullptr && (robot % 3 != 0 || cycle % 2 == 0)) {
            if (client->Run(Exchange(cycle, speed, until), {}, answer) != Outcome::kAnswered) {
              return;
            }
          } else if (!agent.Exchange(clock, cycle, world::DriveCommand{speed, 0, 0}, until,
                                     kTimeout)) {
            return;
          }
        }
      });
      ASSERT_TRUE(simulation->AddRobot(
          Robot("robot_" + std::to_string(robot), -robot, 0.5 * robot, behaviour)));
    }
    ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
    hashes.push_back(simulation->state_hash());
  }
  EXPECT_EQ(hashes[1], hashes[0]);
  EXPECT_EQ(hashes[2], hashes[0]);
}

TEST(CycleClient, ARefusedCycleIsRepeatedByACallThatReportsTheError) {
  auto simulation = Make(Lockstep(100ms));
  int cycles = 0;
  auto behaviour = std::make_shared<ThreadBehaviour>([&](Agent& agent, ClockId clock) {
    const auto client = OpenMemory(agent, clock);
    ASSERT_NE(client, nullptr);
    CycleClient::Answer answer;
    // The first cycle must have the number 1, and a command must be finite.
    EXPECT_EQ(client->Run(Exchange(7, 1, 50ms), {}, answer), Outcome::kRepeat);
    EXPECT_EQ(client->Run(Exchange(1, std::nan(""), 50ms), {}, answer), Outcome::kRepeat);
    const auto refused =
        agent.Exchange(clock, 1, world::DriveCommand{std::nan(""), 0, 0}, 50ms, kTimeout);
    EXPECT_FALSE(refused);
    EXPECT_EQ(client->Run(Exchange(1, 1, 50ms), {}, answer), Outcome::kAnswered);
    // an instant that has passed
    EXPECT_EQ(client->Run(Exchange(2, 1, 10ms), {}, answer), Outcome::kAnswered);
    EXPECT_EQ(answer.reached, 50ms);
    cycles = 2;
  });
  ASSERT_TRUE(simulation->AddRobot(Robot("robot", 0, 0, behaviour)));
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
  EXPECT_EQ(cycles, 2);
}

TEST(CycleClient, AWaitReadsTheNamedSensorsAndHoldsTheTime) {
  auto simulation = Make(Lockstep(100ms));
  std::vector<std::size_t> readings;
  auto behaviour = std::make_shared<ThreadBehaviour>([&](Agent& agent, ClockId clock) {
    ASSERT_TRUE(agent.OpenSensor("front"));
    const auto client = OpenMemory(agent, clock);
    ASSERT_NE(client, nullptr);
    CycleClient::Answer answer;
    EXPECT_EQ(client->Run(Exchange(0, 0.5, 20ms), {"front", "none"}, answer), Outcome::kAnswered);
    EXPECT_TRUE(answer.holds_time);
    readings.push_back(answer.readings.size());
    EXPECT_EQ(agent.Now(), 20ms);
    EXPECT_EQ(client->Run(Exchange(0, 0.5, 40ms), {}, answer), Outcome::kAnswered);
    readings.push_back(answer.readings.size());
  });
  ASSERT_TRUE(simulation->AddRobot(Robot("robot", 0, 0, behaviour)));
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
  EXPECT_EQ(readings, (std::vector<std::size_t>{1, 0}));
}

TEST(CycleClient, AnInterruptedWaitEnds) {
  auto simulation = Make(Lockstep(0s));
  std::unique_ptr<CycleClient> client;
  std::atomic<int> outcome = -1;
  auto behaviour = std::make_shared<ThreadBehaviour>([&](Agent& agent, ClockId clock) {
    client = OpenMemory(agent, clock);
    ASSERT_NE(client, nullptr);
    std::jthread interrupter([&](const std::stop_token& stop) {
      while (!stop.stop_requested()) {
        client->Interrupt();
        std::this_thread::yield();
      }
    });
    CycleClient::Answer answer;
    outcome = static_cast<int>(client->Run(Exchange(1, 0, 10h), {}, answer));
    outcome.notify_all();
  });
  ASSERT_TRUE(simulation->AddRobot(Robot("robot", 0, 0, behaviour)));
  ASSERT_TRUE(simulation->Start());
  outcome.wait(-1);
  EXPECT_NE(outcome, static_cast<int>(Outcome::kAnswered));
  EXPECT_TRUE(simulation->Stop());
}

TEST(CycleClient, MemoryOfAnotherSimulationIsRefused) {
  auto simulation = Make(Lockstep(20ms));
  bool is_refused = false;
  auto behaviour = std::make_shared<ThreadBehaviour>([&](Agent& agent, ClockId clock) {
    const auto memory = agent.ShareMemory(clock);
    ASSERT_TRUE(memory);
    is_refused =
        !CycleClient::Open(memory->file, memory->offset, memory->key + 1) &&
        !CycleClient::Open(memory->file, memory->offset + 1, memory->key) &&
        !CycleClient::Open(memory->file, memory->offset + exchange::kSlotSize, memory->key);
  });
  ASSERT_TRUE(simulation->AddRobot(Robot("robot", 0, 0, behaviour)));
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
  EXPECT_TRUE(is_refused);
}

}  // namespace
}  // namespace gsv::simulation
