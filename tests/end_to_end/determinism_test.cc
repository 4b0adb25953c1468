// The same world, seed and behaviours must give the same state_hash, whatever happens to the
// processes of the behaviours. See docs/determinism.md. GSV_SOAK is the number of repetitions of
// each case (1 in make test, 20 in make soak). GSV_DEBUG_BUILD_DIR names a debug build for
// comparison.
#include <csignal>
#include <cstdlib>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/end_to_end/fleet.h"
#include "tests/support/group.h"
#include "tests/support/other_host.h"

namespace gsv::testing {
namespace {

using ::testing::HasSubstr;

int Rounds() {
  const char* soak = std::getenv("GSV_SOAK");
  return soak == nullptr ? 1 : std::max(1, std::atoi(soak));
}

nlohmann::json ReportOf(const std::string& broker, const std::string& gsv = "gsv") {
  const Outcome outcome = RunProgram(gsv, FleetRun(broker));
  EXPECT_EQ(outcome.ending, "exit code 0") << outcome.err;
  return outcome.LastLine();
}

std::string HashOf(const nlohmann::json& report) { return report.value("state_hash", "none"); }

// The reference for all other runs: the hash of a run in which nothing disturbs the programs.
std::string UndisturbedHash() {
  const BrokerProcess broker;
  const Fleet fleet(broker.reference());
  const auto report = ReportOf(broker.reference());
  for (const auto& robot : report["robots"]) EXPECT_GT(robot["distance_m"], 0.02) << robot;
  return HashOf(report);
}

void ExpectSameHash(const Handicap& handicap) {
  const std::string expected = UndisturbedHash();
  ASSERT_EQ(expected.size(), 16u);
  for (int round = 0; round < Rounds(); ++round) {
    const BrokerProcess broker;
    const Fleet fleet(broker.reference(), handicap);
    ASSERT_EQ(HashOf(ReportOf(broker.reference())), expected) << "round " << round;
  }
}

// Combines the disturbances of the tests below, and records the run.
TEST(Promise, TheSameSeedGivesTheSameHash) {
  const std::string expected = UndisturbedHash();
  ASSERT_EQ(expected.size(), 16u);
  const base::testing::TestFolder folder;
  for (int round = 0; round < Rounds(); ++round) {
    const std::string fault = "GSV_FAULT_DELAY=seed=" + std::to_string(round + 1) + ",max_ms=4";
    const BrokerProcess broker;
    const Fleet fleet(broker.reference(),
                      {.wrapper = {"env", fault, "nice", "-n", "19", "taskset", "-c", "0"},
                       .in_reverse_order = true});
    const std::string file = folder.path() / ("run" + std::to_string(round) + ".mcap");
    const Outcome outcome =
        RunProgram("gsv", FleetRun(broker.reference(), {"--threads", "3", "--record", file}));
    ASSERT_EQ(outcome.ending, "exit code 0") << outcome.err;
    ASSERT_EQ(HashOf(outcome.LastLine()), expected) << fault;
  }
}

// The three robots with rigid-body dynamics, with the disturbances of the other tests combined.
TEST(Determinism, RigidRobotsHaveTheSameHashInEveryRun) {
  const std::vector<std::string> rigid{"--movement", "pebble=rigid"};
  std::vector<std::string> hashes;
  const auto run = [&](const Handicap& handicap, const std::vector<std::string>& more) {
    const BrokerProcess broker;
    const Fleet fleet(broker.reference(), handicap);
    std::vector<std::string> arguments = rigid;
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = RunProgram("gsv", FleetRun(broker.reference(), arguments));
    EXPECT_EQ(outcome.ending, "exit code 0") << outcome.err;
    const auto report = outcome.LastLine();
    for (const auto& robot : report["robots"]) EXPECT_GT(robot["distance_m"], 0.02) << robot;
    hashes.push_back(HashOf(report));
  };
  run({}, {"--threads", "1"});
  EXPECT_EQ(hashes[0].size(), 16u);
  EXPECT_NE(hashes[0], UndisturbedHash());
  for (int round = 0; round < Rounds(); ++round) {
    const std::string fault = "GSV_FAULT_DELAY=seed=" + std::to_string(round + 1) + ",max_ms=4";
    run({.wrapper = {"env", fault, "nice", "-n", "19", "taskset", "-c", "0"},
         .in_reverse_order = true},
        {"--threads", "3"});
    run({}, {"--in-process", "--threads", "2"});
  }
  for (const std::string& hash : hashes) EXPECT_EQ(hash, hashes[0]);
}

TEST(Determinism, RepeatedRunHasTheSameHash) {
  const std::string expected = UndisturbedHash();
  for (int run = 0; run < std::max(3, Rounds()); ++run) ASSERT_EQ(UndisturbedHash(), expected);
}

TEST(Determinism, RunsWithTheSameProgramsHaveTheSameHash) {
  const BrokerProcess broker;
  const Fleet fleet(broker.reference());
  const std::string expected = HashOf(ReportOf(broker.reference()));
  for (int run = 0; run < std::max(3, Rounds()); ++run)
    ASSERT_EQ(HashOf(ReportOf(broker.reference())), expected);
}

TEST(Determinism, HashDoesNotDependOnLowPriorityBehaviours) {
  ExpectSameHash({.wrapper = {"nice", "-n", "19"}});
}

TEST(Determinism, HashDoesNotDependOnBehavioursOnOneCore) {
  ExpectSameHash({.wrapper = {"taskset", "-c", "0"}});
}

TEST(Determinism, HashDoesNotDependOnTheStartOrderOfBehaviours) {
  ExpectSameHash({.in_reverse_order = true});
}

TEST(Determinism, HashDoesNotDependOnSharedMemory) {
  ExpectSameHash({.wrapper = {"env", "GSV_SHARED_MEMORY=0"}});
}

TEST(Determinism, HashDoesNotDependOnRandomCallDelays) {
  const std::string expected = UndisturbedHash();
  for (int round = 0; round < Rounds(); ++round) {
    const std::string fault = "GSV_FAULT_DELAY=seed=" + std::to_string(round + 1) + ",max_ms=4";
    const BrokerProcess broker;
    const Fleet fleet(broker.reference(), {.wrapper = {"env", fault}});
    const auto report = ReportOf(broker.reference());
    ASSERT_EQ(HashOf(report), expected) << fault;
    // There are twelve cycles with at least one call. Each call has two delays of 2 ms on average,
    // which makes 48 ms. A time above 38 ms proves that the delays occurred.
    EXPECT_GT(report["wall_time_s"], 0.038);
  }
}

// Every round trip is delayed by 20 ms, and uses TLS.
TEST(Determinism, HashDoesNotDependOnASlowNetwork) {
  const OtherHost host(20);
  if (!host.refusal().empty()) GTEST_SKIP() << host.refusal();
  const std::string expected = UndisturbedHash();
  const Group group;
  for (int round = 0; round < Rounds(); ++round) {
    const BrokerProcess broker(host.address_here());
    const Fleet fleet(broker.reference(), {.wrapper = host.wrapper()});
    const auto report = ReportOf(broker.reference());
    ASSERT_EQ(HashOf(report), expected) << "round " << round;
    // Twelve cycles, each with at least one call, of at least 20 ms.
    EXPECT_GT(report["wall_time_s"], 12 * 0.020);
  }
}

// While gsv is stopped, the behaviour waits for an answer, as it waits for an image on a busy
// machine.
TEST(Determinism, HashDoesNotDependOnAStopOfTwelveSeconds) {
  const auto hash_of = [](bool is_stopped) {
    Running run("gsv", {"run", "playground", "--robot", "b21r@0,1", "--behaviour", "follow-wall",
                        "--lockstep", "--deadline", "60", "--seed", "1", "--duration", "300",
                        "--port", "0", "--json"});
    if (is_stopped) {
      std::string said;
      while (said.find("viewer: ") == std::string::npos || said.back() != '\n') said = run.errors();
      const std::size_t begin = said.find("http", said.find("viewer: "));
      const std::string url = said.substr(begin, said.find('\n', begin) - begin);
      const auto time = [&] {
        const auto status =
            nlohmann::json::parse(HttpGet(url + "api/simulations/simulation"), nullptr, false);
        return status.is_object() ? status.value("time_s", 0.0) : 0.0;
      };
      while (time() < 1) {
      }
      run.process().Signal(SIGSTOP);
      std::this_thread::sleep_for(std::chrono::seconds(12));
      run.process().Signal(SIGCONT);
    }
    const Outcome outcome = run.AwaitEnd();
    EXPECT_EQ(outcome.ending, "exit code 0") << outcome.err;
    return HashOf(outcome.LastLine());
  };
  EXPECT_EQ(hash_of(true), hash_of(false));
}

TEST(Determinism, HashDoesNotDependOnThreadsOfInProcessBehaviours) {
  const std::string expected = UndisturbedHash();
  const BrokerProcess broker;
  for (const char* threads : {"1", "2", "7"}) {
    const Outcome outcome =
        RunProgram("gsv", FleetRun(broker.reference(), {"--in-process", "--threads", threads}));
    ASSERT_EQ(outcome.ending, "exit code 0") << outcome.err;
    ASSERT_EQ(HashOf(outcome.LastLine()), expected) << threads << " threads";
  }
}

TEST(Determinism, HashOfACrowdDoesNotDependOnThreads) {
  // There are enough robots to divide the work of the mover, the rays and the behaviours between
  // threads.
  std::vector<std::string> hashes;
  for (const char* threads : {"1", "2", "5"}) {
    const Outcome outcome = RunProgram("gsv", {"bench", "crowd", "--robots", "800", "--duration",
                                               "1", "--threads", threads, "--json"});
    ASSERT_EQ(outcome.ending, "exit code 0") << outcome.err;
    hashes.push_back(outcome.LastLine()["rows"][0]["state_hash"]);
  }
  EXPECT_EQ(hashes[0].size(), 16u);
  EXPECT_EQ(hashes[1], hashes[0]);
  EXPECT_EQ(hashes[2], hashes[0]);
}

TEST(Bench, CrowdEqualsABruteForceSearch) {
  const Outcome outcome = RunProgram(
      "gsv", {"bench", "crowd", "--robots", "60", "--duration", "60", "--verify", "--json"});
  EXPECT_EQ(outcome.ending, "exit code 0") << outcome.err;
  const auto row = outcome.LastLine()["rows"][0];
  EXPECT_EQ(row["verified"]["mismatches"], 0);
  EXPECT_GT(row["verified"]["readings"], 100);
  EXPECT_GT(row["collisions"], 0);
}

TEST(Determinism, DebugBuildHasTheHashOfTheReleaseBuild) {
  const char* debug = std::getenv("GSV_DEBUG_BUILD_DIR");
  if (debug == nullptr)
    GTEST_SKIP() << "GSV_DEBUG_BUILD_DIR names no debug build; `make soak` does";
  const std::string expected = UndisturbedHash();
  for (int round = 0; round < Rounds(); ++round) {
    const BrokerProcess broker;
    const Fleet fleet(broker.reference());
    ASSERT_EQ(HashOf(ReportOf(broker.reference(), std::string(debug) + "/bin/gsv")), expected);
  }
}

TEST(Determinism, RecordingDoesNotDependOnDelayedBehaviours) {
  base::testing::TestFolder folder;
  std::vector<std::string> contents;
  for (const char* fault : {"", "seed=3,max_ms=3"}) {
    const std::string file = (folder.path() / ("run" + std::to_string(contents.size()) + ".mcap"));
    const BrokerProcess broker;
    const Fleet fleet(broker.reference(),
                      {.wrapper = {"env", std::string("GSV_FAULT_DELAY=") + fault}});
    const Outcome run = RunProgram("gsv", FleetRun(broker.reference(), {"--record", file}));
    ASSERT_EQ(run.ending, "exit code 0") << run.err;
    contents.push_back(
        RunProgram("gsv", {"rec", "info", file, "--json"}).LastLine().value("content_hash", ""));
  }
  EXPECT_EQ(contents[0].size(), 16u);
  EXPECT_EQ(contents[0], contents[1]);
}

TEST(Determinism, DifferentStepHasADifferentHash) {
  const BrokerProcess broker;
  const Fleet fleet(broker.reference());
  const std::string expected = HashOf(ReportOf(broker.reference()));
  const Outcome longer = RunProgram("gsv", FleetRun(broker.reference(), {"--step", "0.02"}));
  EXPECT_NE(HashOf(longer.LastLine()), expected);
  EXPECT_EQ(HashOf(longer.LastLine()).size(), 16u);
}

TEST(FaultDelay, BehaviourRejectsAnInvalidSetting) {
  Running program("gsv-wander", {"--broker", "corbaloc::127.0.0.1:1/TradingService"},
                  {"env", "GSV_FAULT_DELAY=often"});
  const Outcome outcome = program.AwaitEnd();
  EXPECT_EQ(outcome.ending, "exit code 2");
  EXPECT_THAT(outcome.err, HasSubstr("GSV_FAULT_DELAY=often: expected seed="));
}

}  // namespace
}  // namespace gsv::testing
