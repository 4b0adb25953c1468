// The fixtures of sdk/testing, as somebody else's tests use them.
#include "sdk/testing/scenario_test.h"

#include <cstdlib>
#include <fstream>

#include <gtest/gtest-spi.h>

#include "gsv/base/temporary_folder.h"

namespace gsv::testing {
namespace {

class Here : public ::testing::Environment {
  void SetUp() override {
    const std::string program = std::string(std::getenv("GSV_BUILD_DIR")) + "/bin/gsv";
    setenv("GSV_PROGRAM", program.c_str(), 0);
  }
};
const auto* const here = ::testing::AddGlobalTestEnvironment(new Here);

TEST(ScenarioFixture, AScenarioIsATest) {
  const auto folder = base::TemporaryFolder::Make("gsv-fixture");
  ASSERT_TRUE(folder);
  const std::string file = folder->path() / "still.yaml", failures = folder->path() / "failures";
  std::ofstream(file) << "world: playground\nduration: 1\nrobots: [{model: pebble, x: 0, y: 0}]\n"
                         "expect: [{always: {speed: {robot: pebble, at_most: 0}}}]\n";
  ExpectPasses(file, {"--no-record", "--failures", failures});
  static std::string moving, to;
  moving = folder->path() / "moving.yaml";
  to = failures;
  std::ofstream(moving) << "world: playground\nduration: 1\n"
                           "robots: [{model: pebble, x: 0, y: 0}]\n"
                           "expect: [{eventually: {speed: {robot: pebble, at_least: 1}}}]\n";
  EXPECT_NONFATAL_FAILURE(ExpectPasses(moving, {"--no-record", "--failures", to}),
                          "violated at 1 s");
}

using ASimulator = SimulatorTest;

TEST_F(ASimulator, RunsWhatATestAsksFor) {
  auto simulation = simulator().Create({.world = "playground"});
  ASSERT_TRUE(simulation) << simulation.error().Sentence();
  ASSERT_TRUE((*simulation)->AddRobot({.model = "pebble", .x = 1, .y = 2}));
  ASSERT_TRUE((*simulation)->RunUntil(std::chrono::seconds(1)));
  const auto state = (*simulation)->State();
  ASSERT_TRUE(state);
  EXPECT_EQ(state->robots.at(0).place.x, 1);
  EXPECT_EQ(state->time, std::chrono::seconds(1));
}

}  // namespace
}  // namespace gsv::testing
