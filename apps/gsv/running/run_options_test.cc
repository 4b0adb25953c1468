#include "apps/gsv/running/run_options.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <CLI/CLI.hpp>

#include "gsv/base/test_folder.h"

namespace gsv::app {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Pair;
using ::testing::SizeIs;
using ::testing::UnorderedElementsAre;
using Words = std::vector<std::string>;

base::Result<RunOptions> Parse(Words words) {
  CLI::App app;
  RunArguments arguments;
  AddRunOptions(app, arguments);
  std::reverse(words.begin(), words.end());  // CLI11 expects the words in reverse order
  try {
    app.parse(words);
  } catch (const CLI::ParseError& error) {
    return base::Fail(base::ErrorCode::kInvalidArgument, error.what(), "usage");
  }
  return ParseArguments(arguments);
}

std::string Refusal(const Words& words) {
  const auto options = Parse(words);
  return options ? "taken" : options.error().Sentence();
}

TEST(RunOptions, RunTheDefaultScenarioInRealTimeByDefault) {
  const auto options = Parse({});
  ASSERT_TRUE(options) << options.error().Sentence();
  EXPECT_EQ(options->scenario, scenario::DefaultScenario());
  EXPECT_EQ(options->specification.name, "simulation");
  EXPECT_EQ(options->specification.mode, simulation::Mode::kRealTime);
  EXPECT_EQ(options->specification.factor, 0);  // that of the world
  EXPECT_EQ(options->specification.seed, 0u);
  EXPECT_EQ(options->specification.duration, base::SimTime(0));
  EXPECT_EQ(options->specification.deadline, std::chrono::seconds(10));
  EXPECT_TRUE(options->runtime.viewer);
  EXPECT_EQ(options->record, "");
}

TEST(RunOptions, BehaviourAppliesToAllRobotsOrToOne) {
  const auto options = Parse({"maze", "--robot", "pebble@1,2,90deg", "--robot", "b21r",
                              "--behaviour", "wander", "--behaviour", "pebble=goto --goal-x=3",
                              "--movement", "pebble=rigid", "--drive", "b21r=diff,left=a,right=b"});
  ASSERT_TRUE(options) << options.error().Sentence();
  EXPECT_EQ(options->scenario.world, "maze");
  ASSERT_THAT(options->scenario.robots, SizeIs(2));
  EXPECT_EQ(options->scenario.robots[0].start->y, 2);
  EXPECT_NEAR(options->scenario.robots[0].start->yaw, 1.5707963267948966, 1e-15);
  EXPECT_FALSE(options->scenario.robots[1].start);
  EXPECT_EQ(options->behaviour, "wander");
  EXPECT_THAT(options->behaviour_of, ElementsAre(Pair("pebble", "goto --goal-x=3")));
  EXPECT_THAT(options->movement_of, ElementsAre(Pair("pebble", model::Movement::kRigid)));
  EXPECT_THAT(options->drive_of, ElementsAre(Pair("b21r", "diff,left=a,right=b")));
}

TEST(RunOptions, CommandLineOverridesTheScenarioFile) {
  const base::testing::TestFolder folder;
  const std::string file = folder.Write(
      "s.yaml", "world: maze\nname: s\nseed: 1\nstep: 0.02\nduration: 3\nmode: lockstep\n");
  const auto as_it_is = Parse({file});
  ASSERT_TRUE(as_it_is) << as_it_is.error().Sentence();
  ASSERT_THAT(as_it_is->problems, IsEmpty());
  EXPECT_EQ(as_it_is->specification.mode, simulation::Mode::kLockstep);
  const auto options = Parse({file, "--seed", "7", "--duration", "5", "--real-time",
                              "--real-time-factor", "2", "--on-failure", "fail", "--name", "n"});
  ASSERT_TRUE(options) << options.error().Sentence();
  EXPECT_EQ(options->specification.seed, 7u);
  EXPECT_EQ(options->specification.duration, std::chrono::seconds(5));
  EXPECT_EQ(options->specification.step, std::chrono::milliseconds(20));
  EXPECT_EQ(options->specification.mode, simulation::Mode::kRealTime);
  EXPECT_EQ(options->specification.factor, 2);
  EXPECT_EQ(options->specification.on_failure, simulation::FailurePolicy::kFail);
  EXPECT_EQ(options->specification.name, "n");
}

TEST(RunOptions, FormerNameOfTheRealTimeFactorIsAccepted) {
  const auto options = Parse({"maze", "--factor", "2.5"});
  ASSERT_TRUE(options) << options.error().Sentence();
  EXPECT_EQ(options->specification.factor, 2.5);
}

TEST(RunOptions, ARealTimeFactorOfZeroIsRefused) {
  EXPECT_EQ(Refusal({"maze", "--real-time-factor", "0"}), "--real-time-factor: must be above 0");
}

TEST(RunOptions, RecordingOptionsSetTopicsRatesAndFormat) {
  const auto options = Parse({"maze", "--record", "x.mcap", "--record-topics", "/gsv/poses,/scout/",
                              "--record-rate", "poses=10,beams=0.5", "--record-pictures", "png"});
  ASSERT_TRUE(options) << options.error().Sentence();
  EXPECT_EQ(options->record, "x.mcap");
  EXPECT_THAT(options->recording.topics, UnorderedElementsAre("/gsv/poses", "/scout/"));
  EXPECT_EQ(options->recording.poses_rate, 10);
  EXPECT_EQ(options->recording.beams_rate, 0.5);
  EXPECT_EQ(options->recording.readings_rate, 20);  // the default that --help prints
  EXPECT_TRUE(options->recording.png);
}

TEST(RunOptions, EachErrorNamesItsOption) {
  const std::pair<Words, const char*> bad[]{
      {{"--behaviour", "=wander"}, "--behaviour =wander: expected NAME or ROBOT=NAME"},
      {{"--behaviour", "r="}, "--behaviour r=: expected NAME or ROBOT=NAME"},
      {{"--movement", "rigid"}, "--movement rigid: expected ROBOT=rigid or ROBOT=planar"},
      {{"--drive", "diff"}, "--drive diff: expected ROBOT=KIND"},
      {{"--drive", "r=hover"}, "--drive r=hover: there is no drive \"hover\""},
      {{"--movement", "=rigid"}, "--movement =rigid: expected"},
      {{"--movement", "r=flying"}, "--movement r=flying: expected"},
      {{"--robot", "pebble@1"}, "pebble@1"},
      {{"--avatar", "person@x,y"}, "person@x,y"},
      {{"--duration", "-1"}, "--duration: must be a number of seconds from 0 to 1e9"},
      {{"--duration", "2e9"}, "--duration: must be a number of seconds"},
      {{"--step", "nan"}, "--step: must be a number of seconds"},
      {{"--record-topics", "/gsv/poses"}, "--record-topics: has an effect only with --record NAME"},
      {{"--record-rate", "poses=1"}, "--record-rate: has an effect only with --record NAME"},
      {{"--record-pictures", "png"}, "--record-pictures: has an effect only with --record NAME"},
      {{"--record", "x", "--record-topics", "poses"}, "a topic must begin with a slash"},
      {{"--record", "x", "--record-rate", "poses=0"}, "--record-rate poses=0: expected poses=HZ"},
      {{"--record", "x", "--record-rate", "sounds=1"}, "--record-rate sounds=1: expected"},
      {{"--record", "true"}, "expected a file NAME.mcap or a folder"},
      {{"--record-pictures", "gif"}, "usage: "},
      {{"--on-failure", "panic"}, "usage: "},
      {{"--lockstep", "--real-time"}, "usage: "},
      {{"--threads", "-1"}, "usage: "},
      {{"--limit", "robots=0"}, "robots must be a whole number from 1 to"},
      {{"none.yaml"}, "none.yaml"}};
  for (const auto& [words, sentence] : bad) {
    Words with_world = words;
    if (words.front().front() == '-') with_world.insert(with_world.begin(), "maze");
    EXPECT_THAT(Refusal(with_world), HasSubstr(sentence)) << words.front();
  }
}

}  // namespace
}  // namespace gsv::app
