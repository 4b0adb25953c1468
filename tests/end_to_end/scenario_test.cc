// Tests scenario files: `gsv run NAME.yaml`, and the scenario in each recording.
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gsv/base/text_file.h"
#include "tests/support/programs.h"

namespace gsv::testing {
namespace {

using ::testing::HasSubstr;
using Strings = std::vector<std::string>;

class Scenario : public ::testing::Test {
 protected:
  static Outcome Run(const std::string& what, const Strings& more = {}) {
    Strings arguments{"run", what, "--headless", "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return RunProgram("gsv", arguments);
  }

  const base::testing::TestFolder folder_{};
};

TEST_F(Scenario, FileEqualsOptions) {
  const std::string file = folder_.Write("room.yaml",
                                         "world: playground\n"
                                         "name: morning\n"
                                         "mode: lockstep\n"
                                         "seed: 3\n"
                                         "duration: 2\n"
                                         "robots:\n"
                                         "  - {model: pebble, x: -2, y: -3.5, yaw: 90deg}\n"
                                         "  - {name: tall, model: b21r, x: 0, y: 1, "
                                         "behaviour: wander}\n");
  const Outcome by_file = Run(file);
  ASSERT_EQ(by_file.ending, "exit code 0") << by_file.err;
  const auto report = by_file.LastLine();
  EXPECT_EQ(report["robots"][0]["name"], "pebble");
  EXPECT_EQ(report["robots"][0]["behaviour"], "");
  EXPECT_EQ(report["robots"][1]["name"], "tall");
  EXPECT_EQ(report["robots"][1]["behaviour"], "wander");
  EXPECT_EQ(report["warnings"].size(), 0u);

  // Options override values of the file, and add to its lists.
  const auto longer = Run(file, {"--duration", "2.5", "--robot", "pebble@2,3"}).LastLine();
  EXPECT_EQ(longer["sim_time_s"], 2.5);
  EXPECT_EQ(longer["robots"].size(), 3u);
  const auto other = Run(file, {"--seed", "4", "--behaviour", "tall=follow-wall"}).LastLine();
  EXPECT_EQ(other["robots"][1]["behaviour"], "follow-wall");
  const auto by_options = Run("playground", {"--lockstep", "--seed", "3", "--duration", "2",
                                             "--robot", "pebble@-2,-3.5,90deg"})
                              .LastLine();
  EXPECT_EQ(by_options["robots"][0]["pose"], report["robots"][0]["pose"]);
}

TEST_F(Scenario, ScenarioOfARecordingHasTheSameHash) {
  const std::string recording = folder_.path() / "run.mcap";
  const std::string file = folder_.path() / "again.yaml";
  // Two robots have no given pose, and one robot has a behaviour with options.
  const Outcome first =
      Run("playground",
          {"--lockstep", "--seed", "5", "--duration", "3", "--robot", "pebble", "--robot", "b21r",
           "--robot", "pebble@-2,-3.5,0.1", "--behaviour", "wander", "--behaviour",
           "b21r=goto --goal-x 1.5", "--avatar", "avatar@1,3", "--record", recording});
  ASSERT_EQ(first.ending, "exit code 0") << first.err;
  const auto info = RunProgram("gsv", {"rec", "info", recording, "--json"}).LastLine();
  EXPECT_THAT(info["attachments"].dump(), HasSubstr("\"scenario.yaml\""));
  const Outcome extracted =
      RunProgram("gsv", {"rec", "extract", recording, "scenario.yaml", "-o", file});
  ASSERT_EQ(extracted.ending, "exit code 0") << extracted.err;
  const Outcome again = Run(file);
  ASSERT_EQ(again.ending, "exit code 0") << again.err;
  const auto robots = first.LastLine()["robots"];
  ASSERT_EQ(robots.size(), 4u);
  for (std::size_t i = 0; i < robots.size(); ++i) {
    for (const char* key : {"name", "model", "behaviour", "pose", "readings"}) {
      EXPECT_EQ(again.LastLine()["robots"][i][key], robots[i][key]);
    }
  }
  EXPECT_EQ(again.LastLine()["state_hash"], first.LastLine()["state_hash"]);
}

TEST_F(Scenario, EachErrorIsReportedWithItsPlace) {
  const std::string file = folder_.Write("bad.yaml",
                                         "world: playground\n"
                                         "moed: lockstep\n"
                                         "robots: [{model: pebble, x: 1, y: north}]\n");
  const Outcome run = Run(file);
  EXPECT_EQ(run.ending, "exit code 3");
  EXPECT_THAT(run.err, HasSubstr("gsv: error: " + file + ":3:35: y must be a number from "));
  EXPECT_THAT(run.err, HasSubstr("gsv: error: " + file + ":2:1: there is no key \"moed\" here; "));
  EXPECT_EQ(Run(folder_.path() / "none.yaml").ending, "exit code 3");
}

TEST_F(Scenario, RobotWithoutAModelMustBeInTheWorld) {
  const std::string file = folder_.Write(
      "room.yaml", "world: playground\nrobots: [{name: Marvin, behaviour: wander}]\n");
  const Outcome run = Run(file);
  EXPECT_EQ(run.ending, "exit code 2");
  EXPECT_THAT(run.err, HasSubstr("Marvin: the world has no robot of this name"));
}

TEST_F(Scenario, ExtractingAMissingAttachmentIsAnError) {
  const std::string recording = folder_.path() / "run.mcap";
  const Strings options{"--lockstep", "--robot",  "pebble@0,0", "--duration",
                        "0.1",        "--record", recording};
  ASSERT_EQ(Run("playground", options).ending, "exit code 0");
  const Outcome none = RunProgram("gsv", {"rec", "extract", recording, "scene.yaml"});
  EXPECT_EQ(none.ending, "exit code 5");
  EXPECT_THAT(none.err, HasSubstr("has no attachment \"scene.yaml\"; `gsv rec info` lists"));
  const std::string scene = folder_.path() / "scene.json";
  EXPECT_EQ(RunProgram("gsv", {"rec", "extract", recording, "scene.json", "-o", scene}).ending,
            "exit code 0");
  EXPECT_EQ(nlohmann::json::parse(base::ReadTextFile(scene))["name"], "playground");
  const Outcome taken =
      RunProgram("gsv", {"rec", "extract", recording, "scene.json", "-o", recording});
  EXPECT_EQ(taken.ending, "exit code 5");
  EXPECT_THAT(taken.err, HasSubstr("File exists"));
}

}  // namespace
}  // namespace gsv::testing
