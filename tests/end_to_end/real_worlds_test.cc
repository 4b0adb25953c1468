// Runs `gsv run` with worlds and robots of other authors, as a user of the README would type it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/programs.h"

namespace gsv::testing {
namespace {

using ::testing::HasSubstr;
using Strings = std::vector<std::string>;

struct Case {
  std::string name, world;
  Strings robots;
  Strings absent;  // files that warnings may report as missing
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

class RealWorld : public ::testing::TestWithParam<Case> {};

TEST_P(RealWorld, RunsWithMovingRobots) {
  const Case& c = GetParam();
  if (!std::filesystem::exists(RealFile(c.world)))
    GTEST_SKIP() << "not here: " << RealFile(c.world);
  Strings arguments{"run",        RealFile(c.world), "--behaviour", "wander",
                    "--lockstep", "--duration",      "20",          "--step",
                    "0.01",       "--seed",          "1",           "--headless",
                    "--json",     "--deadline",      "60"};
  for (const std::string& robot : c.robots) {
    arguments.push_back("--robot");
    arguments.push_back(RealFile(robot));
  }
  const Outcome outcome = RunProgram("gsv", arguments);
  EXPECT_EQ(outcome.ending, "exit code 0") << outcome.err;
  const auto report = outcome.LastLine();
  ASSERT_FALSE(report["robots"].empty()) << outcome.out;
  for (const auto& robot : report["robots"]) EXPECT_GT(robot["distance_m"], 1.0) << robot;
  for (const auto& warning : report["warnings"]) {
    const std::string text = warning;
    // Warnings name the elements that gsv does not support; the tests `InstalledSchema` check the
    // list.
    if (text.find("not supported") != std::string::npos) continue;
    EXPECT_TRUE(std::any_of(c.absent.begin(), c.absent.end(), [&](const std::string& part) {
      return text.find(part) != std::string::npos;
    })) << text;
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, RealWorld,
    ::testing::Values(
        Case{"House",
             "turtlebot3/worlds/turtlebot3_house.world",
             {"turtlebot3/models/turtlebot3_burger@-2,-0.5,0",
              "turtlebot3/models/turtlebot3_waffle@1,1,90deg"},
             {"burger_base.stl", "waffle_base.stl"}},
        Case{"Hexagon",
             "turtlebot3/worlds/turtlebot3_world.world",
             {"turtlebot3/models/turtlebot3_burger@-2,-0.5,0",
              "turtlebot3/models/turtlebot3_waffle@0.5,0.5,0"},
             {"burger_base.stl", "waffle_base.stl"}},
        Case{"Cafe", "gazebo_models/cafe", {"gazebo_models/pioneer2dx@0,-2,90deg"}, {}},
        Case{"WillowGarage", "gazebo_models/willowgarage", {"gazebo_models/pioneer2dx@0,0,0"}, {}},
        Case{"DiffDrive", "gz_sim_worlds/diff_drive.sdf", {}, {}},
        Case{"Shapes",
             "gz_sim_worlds/shapes.sdf",
             {"gazebo_models/pioneer2dx@-3,0,180deg"},
             {"1.11"}},
        Case{"Urdf",
             "turtlebot3/worlds/empty_world.world",
             {"turtlebot3/turtlebot3_description/urdf/turtlebot3_burger.urdf@0,0"},
             {"burger_base.stl"}}),
    [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace gsv::testing
