// Tests `gsv replay --resimulate`, which repeats a recorded run with live behaviours.
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/programs.h"

namespace gsv::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

// A world with one wall, which is `thickness` m thick. Its centre is `x` m in front of the robot.
std::string Room(double x, double thickness = 0.2) {
  const std::string box =
      "<geometry><box><size>" + std::to_string(thickness) + " 8 1</size></box></geometry>";
  return R"(<sdf version="1.7"><world name="room">
    <include><uri>model://ground_plane</uri></include>
    <model name="wall"><static>true</static><pose>)" +
         std::to_string(x) + R"( 0 0.5 0 0 0</pose><link name="link">
      <collision name="c">)" +
         box + R"(</collision><visual name="v">)" + box + R"(</visual>
    </link></model></world></sdf>)";
}

class Resimulation : public ::testing::Test {
 protected:
  Resimulation()
      : world_(folder_.Write("room.sdf", Room(2))), recording_(folder_.path() / "run.mcap") {}

  Outcome Record(std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments{
        "run", world_.string(), "--robot", "pebble@0,0", "--behaviour",       "wander",    "--seed",
        "7",   "--duration",    "2",       "--record",   recording_.string(), "--headless"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return RunProgram("gsv", arguments);
  }

  const base::testing::TestFolder folder_{};
  const std::filesystem::path world_, recording_;
};

TEST_F(Resimulation, ReportsThatARunRepeats) {
  const Outcome recorded = Record({"--lockstep"});
  ASSERT_EQ(recorded.ending, "exit code 0") << recorded.err;
  const Outcome again = RunProgram("gsv", {"replay", recording_, "--resimulate"});
  EXPECT_EQ(again.ending, "exit code 0") << again.err;
  EXPECT_THAT(again.out, StartsWith("the new run is equal: "));
  EXPECT_THAT(again.out, HasSubstr("2.000 s"));
}

// A ball on the floor rises from the instant at which gravity points upwards.
TEST_F(Resimulation, RepeatsChangesOfGravity) {
  setenv("XDG_RUNTIME_DIR", folder_.path().c_str(), 1);
  unsetenv("GSV_BROKER");
  std::string world = Room(2);
  const std::string ball =
      R"(<model name="ball"><pose>0 3 0.2 0 0 0</pose><link name="link"><collision name="c">
      <geometry><sphere><radius>0.2</radius></sphere></geometry></collision></link></model>)";
  world.insert(world.find("</world>"), ball);
  std::ofstream(world_) << world;
  Running run("gsv", {"run", world_.string(), "--headless", "--lockstep", "--robot", "pebble@0,0",
                      "--record", recording_.string()});
  run.AwaitLine("broker: ");
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (RunProgram("gsv", {"ps", "--json"}).out.find("\"running\"") == std::string::npos) {
    ASSERT_LT(std::chrono::steady_clock::now(), give_up) << "the run does not start";
  }
  for (const std::vector<std::string>& command : {std::vector<std::string>{"pause"},
                                                  {"set-gravity", "--z", "2"},
                                                  {"step", "200"},
                                                  {"stop"}}) {
    const Outcome done = RunProgram("gsv", command);
    ASSERT_EQ(done.ending, "exit code 0") << done.err;
  }
  EXPECT_EQ(run.AwaitEnd().ending, "exit code 0");
  const Outcome again = RunProgram("gsv", {"replay", recording_, "--resimulate"});
  EXPECT_EQ(again.ending, "exit code 0") << again.err << again.out;
  EXPECT_THAT(again.out, StartsWith("the new run is equal: "));
}

// The run has actors, and pedestrians of the world file and of an option.
TEST_F(Resimulation, RepeatsPedestrians) {
  const Outcome recorded =
      RunProgram("gsv", {"run", "hall", "--robot", "pebble@-8,0", "--behaviour", "wander",
                         "--pedestrians", "5@-8,-2,1:8,-2,1", "--seed", "5", "--duration", "2",
                         "--lockstep", "--record", recording_.string(), "--headless"});
  ASSERT_EQ(recorded.ending, "exit code 0") << recorded.err;
  const Outcome again = RunProgram("gsv", {"replay", recording_, "--resimulate"});
  EXPECT_EQ(again.ending, "exit code 0") << again.err;
  EXPECT_THAT(again.out, StartsWith("the new run is equal: "));
  const Outcome by_commands =
      RunProgram("gsv", {"replay", recording_, "--resimulate", "--commands"});
  EXPECT_EQ(by_commands.ending, "exit code 0") << by_commands.err;
}

TEST_F(Resimulation, NamesTheFirstDifference) {
  const Outcome recorded = Record({"--lockstep"});
  ASSERT_EQ(recorded.ending, "exit code 0") << recorded.err;
  std::ofstream(world_) << Room(2.5);
  const Outcome again = RunProgram("gsv", {"replay", recording_, "--resimulate", "--json"});
  EXPECT_EQ(again.ending, "exit code 1") << again.err;
  const auto report = again.LastLine();
  EXPECT_EQ(report["equal"], false);
  // Of the topics that depend on the wall, this topic is the first in alphabetical order.
  EXPECT_EQ(report["first_difference"]["time_s"], 0);
  EXPECT_EQ(report["first_difference"]["topic"], "/gsv/beams");
}

// In real time, the instants at which a behaviour sends its commands depend on the wall clock. The
// recording contains these instants.
TEST_F(Resimulation, RealTimeRunIsRepeatedFromItsCommands) {
  const Outcome recorded = Record();
  ASSERT_EQ(recorded.ending, "exit code 0") << recorded.err;
  const Outcome again =
      RunProgram("gsv", {"replay", recording_, "--resimulate", "--commands", "--json"});
  EXPECT_EQ(again.ending, "exit code 0") << again.out << again.err;
  EXPECT_EQ(again.LastLine()["equal"], true);
}

TEST_F(Resimulation, RecordedCommandsDriveARobotIntoAChangedWall) {
  const Outcome recorded = Record({"--lockstep", "--behaviour", "goto --goal-x 1.2"});
  ASSERT_EQ(recorded.ending, "exit code 0") << recorded.err;
  std::ofstream(world_) << Room(2, 2.6);
  const Outcome again =
      RunProgram("gsv", {"replay", recording_, "--resimulate", "--commands", "--json"});
  EXPECT_EQ(again.ending, "exit code 1") << again.out << again.err;
  EXPECT_GT(again.LastLine()["first_difference"]["time_s"], 0.2);
}

TEST_F(Resimulation, RejectsARecordingWithoutARun) {
  const auto writer = Program("../tests/recording_write_recordings");
  ASSERT_EQ(RunProgram(writer, {folder_.path()}).ending, "exit code 0");
  const Outcome again =
      RunProgram("gsv", {"replay", folder_.path() / "whole.mcap", "--resimulate"});
  EXPECT_THAT(again.err, HasSubstr("only recordings of `gsv run` can be simulated again"));
  EXPECT_EQ(again.ending, "exit code 2");
}

TEST_F(Resimulation, ReportsMissingFilesOfTheRun) {
  const Outcome recorded = Record({"--lockstep"});
  ASSERT_EQ(recorded.ending, "exit code 0") << recorded.err;
  std::filesystem::remove(world_);
  const Outcome again = RunProgram("gsv", {"replay", recording_, "--resimulate"});
  EXPECT_EQ(again.ending, "exit code 3");
  EXPECT_THAT(again.err, HasSubstr(world_.string()));
}

}  // namespace
}  // namespace gsv::testing
