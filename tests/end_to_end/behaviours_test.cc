// Tests the behaviours of gsv in the built-in worlds.
#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/programs.h"

namespace gsv::testing {
namespace {

using Strings = std::vector<std::string>;

nlohmann::json RobotAfter(const std::string& broker, const std::string& world,
                          const std::string& robot, const std::string& behaviour, int seconds) {
  const Outcome outcome = RunProgram(
      "gsv", {"run", world, "--broker", broker, "--robot", robot, "--behaviour", behaviour,
              "--lockstep", "--duration", std::to_string(seconds), "--headless", "--json"});
  EXPECT_EQ(outcome.ending, "exit code 0") << outcome.err;
  return outcome.LastLine()["robots"][0];
}

TEST(Behaviours, WanderMovesTheRobot) {
  const BrokerProcess broker;
  Running program("gsv-wander", {"--broker", broker.reference()});
  program.AwaitLine("offered at");
  const auto robot = RobotAfter(broker.reference(), "office", "b21r@-3,0", "wander", 30);
  EXPECT_GT(robot["distance_m"], 3.0);
  EXPECT_EQ(robot["readings"]["camera"], 30);  // one reading per second
}

TEST(Behaviours, BehaviourWithoutItsLocalSocketIsCalledOverTcp) {
  const BrokerProcess broker;
  const base::testing::TestFolder runtime;
  Running program("gsv-wander", {"--broker", broker.reference()},
                  {"env", "XDG_RUNTIME_DIR=" + runtime.path().string()});
  program.AwaitLine("offered at");
  const auto folder = runtime.path() / "gsv";
  ASSERT_FALSE(std::filesystem::is_empty(folder)) << "no local socket";
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    std::filesystem::remove(entry.path());
  const auto robot = RobotAfter(broker.reference(), "office", "b21r@-3,0", "wander", 5);
  EXPECT_GT(robot["distance_m"], 0.5);
}

TEST(Behaviours, FollowWallKeepsItsDistance) {
  const BrokerProcess broker;
  Running program("gsv-follow-wall", {"--broker", broker.reference()});
  program.AwaitLine("offered at");
  const auto robot =
      RobotAfter(broker.reference(), "playground", "pebble@3,-4.2,0", "follow-wall", 60);
  EXPECT_GT(robot["distance_m"], 8.0);
  EXPECT_EQ(robot["collisions"], 0);
  // The walls of the square are 5 m from its centre.
  const double x = robot["pose"]["x_m"], y = robot["pose"]["y_m"];
  EXPECT_GT(std::max(std::abs(x), std::abs(y)), 5.0 - 1.5) << robot;
}

TEST(Behaviours, GotoReachesItsGoal) {
  const BrokerProcess broker;
  Running program("gsv-goto", {"--broker", broker.reference(), "--goal-x", "-4", "--goal-y", "0"});
  program.AwaitLine("offered at");
  const auto robot = RobotAfter(broker.reference(), "office", "pebble@3,0", "goto", 60);
  EXPECT_NEAR(robot["pose"]["x_m"].get<double>(), -4.0, 0.2) << robot;
  EXPECT_NEAR(robot["pose"]["y_m"].get<double>(), 0.0, 0.2) << robot;
  EXPECT_EQ(robot["agent"], "finished");
}

TEST(Behaviours, FetchTakesACanToItsGoal) {
  const base::testing::TestFolder folder;
  const std::string world =
      folder
          .Write("cans.sdf",
                 "<sdf version='1.9'><world name='w'><include><uri>model://ground_plane</uri>"
                 "</include><include><uri>model://can</uri><pose>1 0 0 0 0 0</pose></include>"
                 "</world></sdf>")
          .string();
  const auto fetch = [&](const std::string& goal_y) {
    const Outcome outcome =
        RunProgram("gsv", {"run", world, "--robot", "porter@0,0", "--behaviour",
                           "fetch --goal-x 0.5 --goal-y " + goal_y, "--in-process", "--lockstep",
                           "--duration", "25", "--headless", "--json"});
    EXPECT_EQ(outcome.ending, "exit code 0") << outcome.err;
    return outcome.LastLine();
  };
  const auto report = fetch("1.2");
  const auto& robot = report["robots"][0];
  EXPECT_EQ(robot["agent"], "finished");
  // The robot drove to the goal with the can, and then 0.3 m back.
  const double away = std::hypot(robot["pose"]["x_m"].get<double>() - 0.5,
                                 robot["pose"]["y_m"].get<double>() - 1.2);
  EXPECT_NEAR(away, 0.3, 0.08) << robot;
  EXPECT_EQ(fetch("1.2")["state_hash"], report["state_hash"]);
}

TEST(Behaviours, WallClockBehaviourWorksInRealTimeOnly) {
  const BrokerProcess broker;
  Running program("../tests/wall_clock_behaviour", {"--broker", broker.reference()});
  program.AwaitLine("offered at");
  Strings arguments{"run",        "playground", "--broker",    broker.reference(),
                    "--robot",    "pebble@0,0", "--behaviour", "old-style",
                    "--duration", "3",          "--headless",  "--json"};
  const Outcome real_time = RunProgram("gsv", arguments);
  ASSERT_EQ(real_time.ending, "exit code 0") << real_time.err;
  EXPECT_GT(real_time.LastLine()["robots"][0]["distance_m"], 0.3);
  arguments.push_back("--lockstep");
  const Outcome lockstep = RunProgram("gsv", arguments);
  EXPECT_EQ(lockstep.ending, "exit code 4");
  EXPECT_NE(lockstep.err.find("uses the wall clock"), std::string::npos) << lockstep.err;
}

TEST(Behaviours, OptionsAreReadAfterTheNameInEveryForm) {
  std::vector<std::string> hashes;
  for (const bool in_process : {false, true}) {
    Strings arguments{"run",         "playground",        "--robot",    "pebble@0,0",
                      "--behaviour", "goto --goal-x=1.5", "--lockstep", "--duration",
                      "20",          "--headless",        "--json"};
    if (in_process) arguments.push_back("--in-process");
    const Outcome outcome = RunProgram("gsv", arguments);
    ASSERT_EQ(outcome.ending, "exit code 0") << outcome.err;
    EXPECT_NEAR(outcome.LastLine()["robots"][0]["pose"]["x_m"].get<double>(), 1.5, 0.2);
    hashes.push_back(outcome.LastLine()["state_hash"]);
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

TEST(Behaviours, MissingPlugInAndUnknownOptionAreReported) {
  const auto run = [](const char* behaviour) {
    return RunProgram("gsv", {"run", "playground", "--robot", "pebble@0,0", "--behaviour",
                              behaviour, "--in-process", "--headless", "--duration", "1"});
  };
  const Outcome absent = run("dance");
  EXPECT_EQ(absent.ending, "exit code 4");
  EXPECT_NE(absent.err.find("there is no plug-in gsv-dance.so in"), std::string::npos)
      << absent.err;
  const Outcome unknown = run("goto --goal-w 3");
  EXPECT_EQ(unknown.ending, "exit code 2");
  EXPECT_NE(unknown.err.find("goal-w"), std::string::npos) << unknown.err;
}

}  // namespace
}  // namespace gsv::testing
