// Tests the built-in worlds with the built-in robots.
#include <gtest/gtest.h>

#include "tests/support/programs.h"

namespace gsv::testing {
namespace {

using Strings = std::vector<std::string>;

nlohmann::json Simulate(const std::string& world, const Strings& more) {
  Strings arguments{"run",    world, "--lockstep", "--duration", "12",
                    "--seed", "1",   "--headless", "--json"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const Outcome outcome = RunProgram("gsv", arguments);
  EXPECT_EQ(outcome.ending, "exit code 0") << outcome.err;
  auto report = outcome.LastLine();
  EXPECT_TRUE(report["warnings"].empty()) << report["warnings"];
  return report;
}

TEST(BuiltInWorlds, RobotsMoveInEachWorld) {
  const std::pair<const char*, Strings> worlds[] = {
      {"warehouse", {"--robot", "courier@-4,0", "--robot", "b21r@0,1"}},
      {"yard", {"--robot", "courier@0,-9,90deg", "--robot", "b21r@8,-4"}},
      {"playground", {"--robot", "courier@0,0"}},
  };
  for (auto [world, robots] : worlds) {
    robots.insert(robots.end(), {"--behaviour", "wander"});
    const auto report = Simulate(world, robots);
    ASSERT_FALSE(report["robots"].empty()) << world;
    for (const auto& robot : report["robots"]) {
      EXPECT_GT(robot["distance_m"], 1.0) << world << " " << robot;
      EXPECT_EQ(robot["collisions"], 0) << world << " " << robot;
    }
  }
}

// The platform of the yard is 0.5 m high; its gentle ramp begins at x = 1.5.
TEST(BuiltInWorlds, RigidRobotClimbsTheRampAndPlanarRobotStopsAtIt) {
  const Strings up = {"--robot", "rover4@0.9,5.5", "--behaviour", "goto --goal-x 5.2 --goal-y 5.5"};
  Strings rigid = up;
  rigid.insert(rigid.end(), {"--movement", "rover4=rigid"});
  const auto climbed = Simulate("yard", rigid)["robots"][0]["pose"];
  EXPECT_GT(climbed["x_m"], 4.5) << climbed;
  EXPECT_NEAR(climbed["z_m"], 0.5, 0.01) << climbed;
  const auto stopped = Simulate("yard", up)["robots"][0]["pose"];
  EXPECT_NEAR(stopped["z_m"], 0, 1e-6) << stopped;
}

}  // namespace
}  // namespace gsv::testing
