// Tests a behaviour on another ORB and in another language: examples/tcl/wander.tcl, on Combat.
#include <cstdlib>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/programs.h"

namespace gsv::testing {
namespace {

using ::testing::HasSubstr;
using Strings = std::vector<std::string>;

std::string WanderTcl() {
  return std::string(std::getenv("GSV_SOURCE_DIR")) + "/examples/tcl/wander.tcl";
}

int Rounds() {
  const char* soak = std::getenv("GSV_SOAK");
  return 2 + (soak == nullptr ? 0 : std::atoi(soak));
}

Strings RunWith(const std::string& broker, Strings more) {
  Strings arguments{"run",         "playground", "--broker",   broker,       "--robot", "pebble",
                    "--behaviour", "wander-tcl", "--lockstep", "--headless", "--seed",  "1"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

TEST(ForeignOrb, TclBehaviourRunsInLockstepWithARepeatableHash) {
  std::string first;
  for (int round = 0; round < Rounds(); ++round) {
    const BrokerProcess broker;
    Running tcl(WanderTcl(), {"--broker", broker.reference()});
    tcl.AwaitLine("offered at");
    const Outcome run =
        RunProgram("gsv", RunWith(broker.reference(), {"--duration", "10", "--json"}));
    ASSERT_EQ(run.ending, "exit code 0") << run.err << tcl.errors();
    const auto report = run.LastLine();
    EXPECT_EQ(report["robots"][0]["agent"], "waiting");
    EXPECT_GT(report["robots"][0]["distance_m"], 1.0);
    // At least one reading in each of 20 cycles per second; no behaviour is woken at the last
    // instant.
    EXPECT_GE(report["robots"][0]["readings"]["sonar"], 200);
    if (first.empty()) first = report["state_hash"];
    ASSERT_EQ(report["state_hash"], first);
  }
}

TEST(ForeignOrb, TclBehaviourIsStoppedAndRestarted) {
  const BrokerProcess broker;
  Running tcl(WanderTcl(), {"--broker", broker.reference()});
  tcl.AwaitLine("offered at");
  Running run("gsv", RunWith(broker.reference(), {}));
  run.AwaitLine("broker: ");
  const auto gsv = [&](Strings arguments) {
    arguments.insert(arguments.end(), {"--broker", broker.reference(), "--json"});
    const Outcome outcome = RunProgram("gsv", arguments);
    EXPECT_EQ(outcome.ending, "exit code 0") << outcome.err << tcl.errors();
    return outcome.LastLine();
  };
  EXPECT_EQ(gsv({"pause"})["phase"], "paused");
  EXPECT_EQ(gsv({"reset"})["robots"][0]["agent_phase"], "initialised");
  const auto first = gsv({"step", "100"});
  EXPECT_EQ(first["robots"][0]["agent_phase"], "waiting");
  gsv({"reset"});
  EXPECT_EQ(gsv({"step", "100"})["state_hash"], first["state_hash"]);
  EXPECT_EQ(gsv({"resume"})["phase"], "running");
  gsv({"stop"});
  EXPECT_EQ(run.AwaitEnd().ending, "exit code 0") << tcl.errors();
  EXPECT_EQ(tcl.errors(), "");
}

TEST(ForeignOrb, TclBehaviourReportsAnErrorInOneSentence) {
  const Outcome usage = RunProgram(WanderTcl(), {"--name", "x"});
  EXPECT_EQ(usage.ending, "exit code 2");
  EXPECT_THAT(usage.err, HasSubstr("usage: wander.tcl --broker"));
  const Outcome nobody = RunProgram(WanderTcl(), {"--broker", "corbaloc::127.0.0.1:1/Nobody"});
  EXPECT_EQ(nobody.ending, "exit code 5");
  EXPECT_THAT(nobody.err, HasSubstr("127.0.0.1:1"));
}

}  // namespace
}  // namespace gsv::testing
