// Tests `gsv test`, which runs scenarios as tests.
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/programs.h"

namespace gsv::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using Strings = std::vector<std::string>;
namespace fs = std::filesystem;

std::string TextOf(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

constexpr const char* kStands =
    "world: playground\nduration: 1\nrobots: [{model: pebble, x: 0, y: 0}]\n";

class TestCommand : public ::testing::Test {
 protected:
  Outcome Test(Strings arguments) const {
    arguments.insert(arguments.begin(), "test");
    arguments.insert(arguments.end(), {"--failures", (folder_.path() / "failures").string()});
    return RunProgram("gsv", arguments);
  }
  std::string Scenario(const std::string& name, const std::string& more) const {
    return folder_.Write(name, kStands + more);
  }

  const base::testing::TestFolder folder_{};
};

TEST_F(TestCommand, ReportsTheScenariosOfAFolder) {
  Scenario("t/good.yaml", "expect: [{never_collides: pebble}]\n");
  Scenario("t/worse.yaml", "expect: [{reaches: {robot: pebble, x: 3, y: 4}, by: 0.5}]\n");
  Scenario("t/crashes.yaml", "avatars: [{model: no_such_model}]\n");
  const std::string junit = folder_.path() / "junit.xml";
  const Outcome run = Test({folder_.path() / "t", "--junit", junit, "--jobs", "2"});
  EXPECT_EQ(run.ending, "exit code 1") << run.err;
  EXPECT_THAT(run.out, HasSubstr("PASS  " + (folder_.path() / "t/good").string()));
  EXPECT_THAT(run.out, HasSubstr("violated at 0.5 s"));
  EXPECT_THAT(run.out, HasSubstr("the distance of pebble from (3, 4) was 5 m (at most 0.25"));
  EXPECT_THAT(run.out, HasSubstr("1 passed, 1 failed, 1 error in"));
  const std::string xml = TextOf(junit);
  EXPECT_THAT(xml, HasSubstr("tests=\"3\" failures=\"1\" errors=\"1\""));
  EXPECT_THAT(xml, HasSubstr("name=\"worse\""));
  EXPECT_THAT(xml, HasSubstr("<error message=\"the run ended with exit code 3\">"));
}

TEST_F(TestCommand, FailureKeepsItsFiles) {
  const std::string file =
      folder_.Write("moves.yaml",
                    "world: playground\nduration: 14\nin_process: true\nseed: 5\n"
                    "robots: [{name: scout, model: pebble, x: -2, y: -3.5, behaviour: wander}]\n"
                    "expect: [{name: too far, always: {travelled: {robot: scout, at_most: 2}}}]\n");
  const Outcome run = Test({file, "--json", "--keep", "3"});
  EXPECT_EQ(run.ending, "exit code 1") << run.err;
  const auto result = run.LastLine()["results"][0];
  EXPECT_EQ(result["status"], "failed");
  const fs::path left = result["folder"].get<std::string>();
  EXPECT_EQ(TextOf(left / "scenario.yaml"), TextOf(file));
  EXPECT_EQ(TextOf(left / "picture.jpg").substr(0, 2), "\xff\xd8");
  const double failed = result["report"]["expectations"][0]["time_s"];
  const auto info = RunProgram("gsv", {"rec", "info", left / "run.mcap", "--json"}).LastLine();
  EXPECT_NEAR(info["start_s"].get<double>(), failed - 3, 0.1) << info;
  EXPECT_EQ(RunProgram("gsv", {"replay", "--headless", left / "run.mcap"}).ending, "exit code 0");
  EXPECT_THAT(TextOf(left / "README.txt"), HasSubstr("#t="));
  EXPECT_GE(info["start_s"].get<double>() + info["duration_s"].get<double>(),
            std::min(failed + 1.9, 13.9))
      << "the recording spans the violation";
  const auto listed = RunProgram("gsv", {"rec", "list", left.parent_path(), "--json"}).LastLine();
  EXPECT_EQ(listed["name"], left.filename().string());
  EXPECT_EQ(listed["verdict"], "failed") << listed;
  EXPECT_THAT(listed["sentence"].get<std::string>(), HasSubstr("too far: violated at "));
  EXPECT_NEAR(listed["violation_s"].get<double>(), failed, 1e-3);
  EXPECT_EQ(listed["world"], "playground");
  EXPECT_EQ(listed["robots"], 1);
  // `gsv run` of the same scenario must fail at the same step.
  const Outcome again = RunProgram("gsv", {"run", file, "--lockstep", "--headless", "--json"});
  EXPECT_EQ(again.ending, "exit code 1");
  EXPECT_EQ(again.LastLine()["expectations"][0]["step"],
            result["report"]["expectations"][0]["step"]);
  EXPECT_EQ(again.LastLine()["state_hash"], result["state_hashes"][0]);
  EXPECT_THAT(again.err, HasSubstr("moves.yaml:6:10: too far: violated at "));
}

TEST_F(TestCommand, FailureRemovesOnlyFoldersOfFailures) {
  const std::string expect = "expect: [{reaches: {robot: pebble, x: 3, y: 4}, by: 0.5}]\n";
  const std::string file = Scenario("room.yaml", expect);
  const auto folder = [&](const char* drive) -> fs::path {
    const Outcome run = Test({file, "--no-record", "--json", "--drive", drive});
    return run.LastLine()["results"][0]["folder"].get<std::string>();
  };
  const fs::path kept = folder("pebble=omni");
  EXPECT_THAT(TextOf(kept / "README.txt"), HasSubstr("--lockstep --drive 'pebble=omni'\n"));
  EXPECT_EQ(folder("pebble=omni"), kept);
  fs::remove_all(kept);
  fs::create_directory(kept);
  std::ofstream(kept / "notes.txt") << "important";
  EXPECT_EQ(folder("pebble=omni"), kept.string() + "_2");
  EXPECT_EQ(TextOf(kept / "notes.txt"), "important");
}

TEST_F(TestCommand, TheClipSpansAllViolations) {
  const std::string file =
      folder_.Write("two.yaml",
                    "world: playground\nduration: 8\nrobots: [{model: pebble, x: 0, y: 0}]\n"
                    "expect: [{always: {time: {at_most: 6}}}, {always: {time: {at_most: 2}}}]\n");
  const Outcome run = Test({file, "--json", "--keep", "1", "--keep-after", "0.5"});
  EXPECT_EQ(run.ending, "exit code 1") << run.err;
  const auto result = run.LastLine()["results"][0];
  const double last = result["report"]["expectations"][0]["time_s"];
  const double first = result["report"]["expectations"][1]["time_s"];
  EXPECT_LT(first, last);
  const fs::path clip = fs::path(result["folder"].get<std::string>()) / "run.mcap";
  const auto info = RunProgram("gsv", {"rec", "info", clip, "--json"}).LastLine();
  EXPECT_NEAR(info["start_s"].get<double>(), first - 1, 0.1) << info;
  EXPECT_NEAR(info["start_s"].get<double>() + info["duration_s"].get<double>(), last + 0.5, 0.1);
}

TEST_F(TestCommand, RepetitionsHaveTheSameHash) {
  const std::string file =
      Scenario("still.yaml", "seed: 9\nexpect: [{always: {inside: {robot: pebble, x: [0, 0]}}}]\n");
  const Outcome run = Test({file, "--repeat", "3", "--no-record", "--json"});
  EXPECT_EQ(run.ending, "exit code 0") << run.err;
  const auto hashes = run.LastLine()["results"][0]["state_hashes"];
  ASSERT_EQ(hashes.size(), 3u);
  EXPECT_EQ(hashes[0], hashes[2]);
}

TEST_F(TestCommand, ShardsTogetherRunEveryScenario) {
  for (int i = 0; i < 3; ++i) Scenario("t/" + std::to_string(i) + ".yaml", "");
  const std::string scenarios = folder_.path() / "t";
  const auto first = Test({scenarios, "--shard", "1/2", "--no-record", "--json"}).LastLine();
  const auto second = Test({scenarios, "--shard", "2/2", "--no-record", "--json"}).LastLine();
  EXPECT_EQ(first["results"].size(), 2u);
  ASSERT_EQ(second["results"].size(), 1u);
  EXPECT_THAT(second["results"][0]["file"].dump(), HasSubstr("1.yaml"));
}

TEST_F(TestCommand, InvalidInputIsReportedBeforeAnythingRuns) {
  const std::string good = Scenario("good.yaml", "");
  const std::string bad = Scenario("bad.yaml", "expect: [{nevermore: pebble}]\n");
  const Outcome run = Test({good, bad});
  EXPECT_EQ(run.ending, "exit code 3");
  EXPECT_THAT(run.err, HasSubstr(bad + ":4:11: there is no key \"nevermore\" here"));
  EXPECT_THAT(run.out, Not(HasSubstr("PASS")));
  EXPECT_EQ(Test({folder_.path() / "none.yaml"}).ending, "exit code 3");
  EXPECT_EQ(Test({good, "--shard", "3/2"}).ending, "exit code 2");
  const Outcome endless = Test({folder_.Write("endless.yaml", "world: playground\n")});
  EXPECT_EQ(endless.ending, "exit code 3");
  EXPECT_THAT(endless.err, HasSubstr("a test needs an end: set duration"));
}

TEST_F(TestCommand, MissingWorldIsOneError) {
  const std::string lost =
      folder_.Write("lost.yaml", "world: atlantis\nduration: 1\nrobots: [{model: pebble}]\n");
  const std::string good = Scenario("good.yaml", "");
  const Outcome run = Test({lost, good, "--no-record"});
  EXPECT_EQ(run.ending, "exit code 3");
  EXPECT_THAT(run.out, HasSubstr("1 passed, 0 failed, 1 error in"));
  EXPECT_THAT(run.out, HasSubstr("atlantis"));
}

TEST_F(TestCommand, ExpectationAboutAnUnknownRobotIsAnErrorWithItsPlace) {
  const std::string file = Scenario("marvin.yaml", "expect: [{never_collides: marvin}]\n");
  const Outcome run = Test({file, "--no-record"});
  EXPECT_EQ(run.ending, "exit code 3");
  EXPECT_THAT(run.out, HasSubstr("marvin.yaml:4:10: there is no body in the world with the name"));
}

}  // namespace
}  // namespace gsv::testing
