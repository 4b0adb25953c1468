#include "gsv/scenario/scenario_file.h"

#include <filesystem>
#include <fstream>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gsv/base/temporary_folder.h"

namespace gsv::scenario {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<std::string> Sentences(const base::Problems& problems) {
  std::vector<std::string> sentences;
  for (const base::Problem& problem : problems) sentences.push_back(problem.Sentence());
  return sentences;
}

// Returns the problems that ParseScenario() reports for a text, one sentence each.
std::vector<std::string> ProblemsIn(const std::string& text) {
  base::Problems problems;
  const auto scenario = ParseScenario(text, "room.yaml", problems);
  if (!scenario) return {scenario.error().Sentence()};
  return Sentences(problems);
}

Scenario Parsed(const std::string& text) {
  base::Problems problems;
  const auto scenario = ParseScenario(text, "room.yaml", problems);
  EXPECT_TRUE(scenario) << scenario.error().Sentence();
  EXPECT_THAT(Sentences(problems), IsEmpty());
  return scenario.value_or(Scenario());
}

TEST(ScenarioFile, ReadsAllKeys) {
  const Scenario scenario = Parsed(R"(
# A room with two robots.
world: office
seed: 18446744073709551615
mode: lockstep
duration: 60
in_process: true
robots:
  - model: b21r
    name: tall one
    x: -3
    y: 0.5
    yaw: 90deg
    behaviour: goto --goal-x 3
  - {model: pebble, movement: rigid, drive: "skid,left=a,right=b,radius=0.2"}
  - {name: turtlebot, behaviour: wander}
avatars:
  - {model: avatar, x: 1, y: 1}
record: run.mcap
record_topics: [/gsv/poses, /tall one/]
record_rates: {poses: 10, pictures: 0.5}
record_pictures: png
)");
  EXPECT_EQ(scenario.world, "office");
  EXPECT_EQ(scenario.seed, std::numeric_limits<std::uint64_t>::max());
  EXPECT_EQ(scenario.lockstep, true);
  EXPECT_EQ(scenario.duration, 60);
  EXPECT_EQ(scenario.in_process, true);
  EXPECT_EQ(scenario.factor, std::nullopt);
  ASSERT_EQ(scenario.robots.size(), 3u);
  EXPECT_EQ(scenario.robots[0].name, "tall one");
  EXPECT_EQ(scenario.robots[0].behaviour, "goto --goal-x 3");
  ASSERT_TRUE(scenario.robots[0].start);
  EXPECT_EQ(scenario.robots[0].start->y, 0.5);
  EXPECT_NEAR(scenario.robots[0].start->yaw, 1.5707963267948966, 1e-15);
  EXPECT_EQ(scenario.robots[1].start, std::nullopt);
  EXPECT_EQ(scenario.robots[1].movement, model::Movement::kRigid);
  EXPECT_EQ(scenario.robots[1].drive, "skid,left=a,right=b,radius=0.2");
  EXPECT_EQ(scenario.robots[2].model, "");
  EXPECT_EQ(scenario.avatars.at(0).start, (Place{1, 1, {}, 0}));
  EXPECT_EQ(scenario.record, "run.mcap");
  EXPECT_THAT(scenario.record_topics, ElementsAre("/gsv/poses", "/tall one/"));
  EXPECT_EQ(scenario.record_rates,
            (std::map<std::string, double>{{"poses", 10}, {"pictures", 0.5}}));
  EXPECT_EQ(scenario.record_png, true);
}

TEST(ScenarioFile, ReadsJson) {
  const Scenario scenario = Parsed(
      R"({"world": "yard", "real_time_factor": 2.5, "robots": [{"model": "pebble", "x": 1, "y": -2}]})");
  EXPECT_EQ(scenario.world, "yard");
  EXPECT_EQ(scenario.factor, 2.5);
  EXPECT_EQ(scenario.robots.at(0).start, (Place{1, -2, {}, 0}));
}

TEST(ScenarioFile, FormerNameOfTheRealTimeFactorIsAccepted) {
  EXPECT_EQ(Parsed("{world: yard, factor: 2.5}").factor, 2.5);
  base::Problems problems;
  (void)ParseScenario("{world: yard, factor: 2, real_time_factor: 2}", "s.yaml", problems);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_THAT(problems[0].message, ::testing::HasSubstr("is the former name of real_time_factor"));
}

TEST(ScenarioFile, WrittenScenarioIsReadBackUnchanged) {
  Scenario scenario;
  scenario.world = "my worlds/room: \"2\" #1.sdf";
  scenario.name = "true";
  scenario.seed = 1;
  scenario.lockstep = false;
  scenario.factor = 1.0 / 3;
  scenario.step = 0.001;
  scenario.duration = 3600;
  scenario.deadline = 10;
  scenario.fails_with_behaviour = true;
  scenario.in_process = false;
  scenario.model_path = {"/models", "-x", "a\tb\n\\c", "ä{1}", ""};
  scenario.robots = {
      {"b21r", "r,1", Place{0.1, -1e-300, 2.5, 3.0000000000000004}, "goto --goal-x 3", "", {}},
      {"pebble", "0x10", Place{1e6, 0, {}, 0}, "", "pid > 0", model::Movement::kPlanar},
      {"", "null", {}, "wander", "", {}},
      {"~", "", {}, "", "", model::Movement::kRigid}};
  scenario.avatars = {{"avatar", "Ann", Place{1, 2, {}, 3}, "", "", {}}};
  model::PedestrianGroup group;
  group.name = "no one";
  group.count = 40;
  group.route = {{-1.0 / 3, 2, 0.1}, {4, 1e-300, 0}};
  group.speed = 1.1;
  scenario.pedestrians = {group, group};
  scenario.record = "no";
  scenario.record_topics = {"/gsv/", "/a b"};
  scenario.record_rates = {{"beams", 0.001}};
  scenario.record_png = false;
  scenario.ros2 = {
      "localhost", "twist_stamped", "humble", {{"a: b", "/"}, {"pebble", "/fleet/one"}}};
  EXPECT_EQ(Parsed(ToYaml(scenario)), scenario) << ToYaml(scenario);
  EXPECT_EQ(Parsed(ToYaml(DefaultScenario())), DefaultScenario());
  EXPECT_EQ(Parsed(ToYaml(Scenario())), Scenario());
}

TEST(ScenarioFile, Ros2KeyAcceptsAFlagOrSettings) {
  EXPECT_EQ(Parsed("ros2: false").ros2, std::nullopt);
  EXPECT_EQ(Parsed("ros2: true").ros2, Ros2Settings());
  EXPECT_EQ(Parsed("ros2: {distro: kilted, namespaces: {pebble: /}}").ros2,
            (Ros2Settings{"", "", "kilted", {{"pebble", "/"}}}));
  EXPECT_THAT(
      ProblemsIn("ros2:\n  range: world\n  namespaces: {pebble: fleet}\n"),
      ElementsAre("room.yaml:2:10: range must be one of localhost, subnet, found \"world\"",
                  "room.yaml:3:24: a namespace must begin with a slash, such as /fleet, or / "
                  "for none"));
  EXPECT_EQ(ProblemsIn("ros2: maybe").size(), 1u);
}

TEST(ScenarioFile, EachErrorHasLineAndColumn) {
  EXPECT_THAT(
      ProblemsIn("world: office\n"
                 "wrold: office\n"
                 "mode: fast\n"
                 "seed: -1\n"
                 "factor: 0\n"
                 "robots:\n"
                 "  - {model: pebble, x: 1}\n"
                 "  - {model: pebble, x: 1, y: far}\n"
                 "  - {behaviour: wander}\n"
                 "  - {name: r, x: 1, y: 1}\n"
                 "  - pebble\n"
                 "avatars:\n"
                 "  - {name: Ann, behaviour: wander}\n"
                 "record_topics: /clock\n"
                 "world: yard\n"),
      ElementsAre(
          "room.yaml:15:1: the key \"world\" occurs twice",
          "room.yaml:4:7: seed must be a whole number from 0 to 18446744073709551615, "
          "found \"-1\"",
          "room.yaml:3:7: mode must be real_time or lockstep, found \"fast\"",
          "room.yaml:5:9: factor must be a number from 1e-06 to 1e+06, found \"0\"",
          "room.yaml:7:5: a place needs both x and y",
          "room.yaml:8:30: y must be a number from -1e+06 to 1e+06, found \"far\"",
          "room.yaml:9:5: a robot needs a model, or the name of a robot in the world file",
          "room.yaml:10:5: a robot without a model is in the world file, which defines "
          "where it starts and how it moves",
          "room.yaml:11:5: expected a mapping (key: value), found \"pebble\"",
          "room.yaml:13:5: an avatar needs a model",
          "room.yaml:13:17: there is no key \"behaviour\" here; the known keys are name, model, x, "
          "y, z, yaw",
          "room.yaml:14:16: record_topics must be a list, found \"/clock\"",
          HasSubstr("room.yaml:2:1: there is no key \"wrold\" here; the known keys are world, ")));
}

TEST(ScenarioFile, ReportsErrorsOfPedestrians) {
  EXPECT_THAT(ProblemsIn("pedestrians:\n"
                         "  - {count: 3}\n"
                         "  - {route: [{x: 1}], speed: 11}\n"
                         "  - {route: [{x: 1, y: 2}], count: 1000000}\n"),
              ElementsAre("room.yaml:2:5: pedestrians need a route of at least one goal",
                          "room.yaml:3:14: a goal needs both x and y",
                          HasSubstr("room.yaml:3:30: speed must be a number from 0.01 to 10"),
                          "room.yaml:4:5: a group has 1 to 100,000 pedestrians"));
}

TEST(ScenarioFile, StepOfZeroSelectsTheWorldsStep) {
  EXPECT_EQ(Parsed("step: 0").step, std::nullopt);
  EXPECT_THAT(
      ProblemsIn("step: 1e-9"),
      ElementsAre("room.yaml:1:7: a step is at least 1 microsecond, or 0 for the world's step"));
}

TEST(ScenarioFile, NumberInQuotesIsAText) {
  EXPECT_THAT(ProblemsIn("seed: \"1\"\nin_process: 'true'\n"),
              ElementsAre("room.yaml:1:7: seed must be a whole number from 0 to "
                          "18446744073709551615, found the text \"1\"",
                          "room.yaml:2:13: in_process must be false or true, found the text "
                          "\"true\""));
}

TEST(ScenarioFile, RejectsTrueAsTheNameOfARecording) {
  EXPECT_THAT(ProblemsIn("record: true\n"),
              ElementsAre("room.yaml:1:9: record must be a file, NAME.mcap, or a folder, found "
                          "\"true\""));
  EXPECT_THAT(ProblemsIn("record: truth\n"), ElementsAre());
}

TEST(ScenarioFile, BehaviourIsChosenByNameOrByConstraint) {
  const Scenario scenario =
      Parsed("robots: [{model: pebble, behaviour_constraint: \"name == 'wander'\"}]");
  EXPECT_EQ(scenario.robots.at(0).behaviour_constraint, "name == 'wander'");
  EXPECT_THAT(ProblemsIn("robots: [{model: m, behaviour: a, behaviour_constraint: b}]"),
              ElementsAre("room.yaml:1:57: choose a behaviour by name or by constraint, not by "
                          "both"));
}

TEST(ScenarioFile, FileThatIsNotAScenarioIsRefused) {
  EXPECT_THAT(ProblemsIn(""), ElementsAre(HasSubstr("room.yaml: the file is empty")));
  EXPECT_THAT(ProblemsIn("world: a\nrobots: ]\n"),
              ElementsAre("room.yaml:2:9: this is not valid YAML: illegal flow end"));
  EXPECT_THAT(ProblemsIn("a text"),
              ElementsAre("room.yaml:1:1: expected a mapping (key: value), found \"a text\""));
  EXPECT_THAT(ProblemsIn("world: a\n---\nworld: b\n"),
              ElementsAre("room.yaml:2:1: a file may contain one scenario; this is a second one"));
  EXPECT_THAT(ProblemsIn(std::string(kMaxScenarioBytes + 1, ' ')),
              ElementsAre(HasSubstr("at most 4194304 bytes")));
  EXPECT_THAT(ProblemsIn(std::string(100'000, '[')),
              ElementsAre(HasSubstr("this is not valid YAML")));
}

TEST(ScenarioFile, ContentAfterTheScenarioIsRefused) {
  EXPECT_THAT(ProblemsIn("world: a\n, b\n"), ::testing::Not(IsEmpty()));
  // Regression, found by the fuzzer: yaml-cpp's function that reads all documents did not return
  // for this text.
  EXPECT_THAT(ProblemsIn(", [b: |\n  two\n  *a\nror\nwoe: !!str 0\nm]]\n\n"),
              ::testing::Not(IsEmpty()));
}

TEST(ScenarioFile, TextThatIsNotUtf8IsRefused) {
  for (const char* bytes : {"\xff", "\xc3", "\xe2\x82", "\xc3(", "\x80", "\xc0\xaf"}) {
    EXPECT_THAT(ProblemsIn("seed: 1\nworld: " + std::string(bytes)),
                ElementsAre("room.yaml:2: the text is not UTF-8"));
  }
  EXPECT_EQ(Parsed("world: \xc3\xa4\xe2\x82\xac\xf0\x9f\x98\x80").world,
            "\xc3\xa4\xe2\x82\xac\xf0\x9f\x98\x80");
}

// Regression, found by the fuzzer: yaml-cpp converts each of these escapes to one byte. So the
// scenario could be written, but not be read back.
TEST(ScenarioFile, EscapesThatYamlCppReadsWronglyAreRefused) {
  for (const char* text : {R"(world: "a\_b")", R"(world: "a\Nb")"}) {
    EXPECT_THAT(ProblemsIn(text), ElementsAre(HasSubstr("are misread in quoted texts")));
  }
  EXPECT_EQ(Parsed(R"(world: "a\u00a0b")").world,
            "a\xc2\xa0"
            "b");
  EXPECT_EQ(Parsed(R"(world: 'a\_b\N')").world, R"(a\_b\N)");
}

TEST(ScenarioFile, ControlCharacterIsRefused) {
  for (const char c : {'\0', '\x01', '\v', '\f', '\x1b', '\x7f'}) {
    EXPECT_THAT(ProblemsIn("seed: 1\nworld: a" + std::string(1, c) + "b"),
                ElementsAre("room.yaml:2: the text contains a control character"));
  }
  EXPECT_EQ(Parsed("world: a # with a\ttabulator\r\n").world, "a");
}

TEST(ScenarioFile, AliasesCannotExpandToALargeScenario) {
  std::string robots = "robots:\n  - &r {";
  for (int i = 0; i < 10'000; ++i) robots += "k" + std::to_string(i) + ": 1, ";
  robots += "}\n";
  for (int i = 0; i < 90'000; ++i) robots += "  - *r\n";
  EXPECT_EQ(ProblemsIn(robots).size(), 100u);
  EXPECT_THAT(ProblemsIn(robots + robots.substr(robots.find("  - *r"))),
              ElementsAre(HasSubstr("robots has at most 100000 entries")));
}

TEST(ScenarioFile, SizeIsLimited) {
  const std::string padded = "world: a\n#";
  EXPECT_THAT(ProblemsIn(padded + std::string(kMaxScenarioBytes - padded.size(), 'x')),
              ElementsAre());
  EXPECT_THAT(ProblemsIn(padded + std::string(kMaxScenarioBytes + 1 - padded.size(), 'x')),
              ElementsAre(HasSubstr("at most 4194304 bytes")));
  std::string robots = "robots:\n  - &r {model: m}\n";
  for (int i = 1; i < 100'000; ++i) robots += "  - *r\n";
  EXPECT_EQ(Parsed(robots).robots.size(), 100'000u);
  EXPECT_THAT(ProblemsIn(robots + "  - *r\n"),
              ElementsAre(HasSubstr("robots has at most 100000 entries")));
}

TEST(ScenarioFile, PathsAreRelativeToItsFolder) {
  const auto folder = base::TemporaryFolder::Make("gsv-scenario");
  ASSERT_TRUE(folder);
  std::ofstream(folder->path() / "room.sdf") << "<sdf/>";
  const std::filesystem::path file = folder->path() / "room.yaml";
  std::ofstream(file) << "world: room.sdf\nrobots: [{model: pebble}]\n";
  base::Problems problems;
  const auto scenario = ReadScenario(file, problems);
  ASSERT_TRUE(scenario);
  EXPECT_EQ(scenario->world, folder->path() / "room.sdf");
  EXPECT_EQ(scenario->robots.at(0).model, "pebble");
  const auto missing = ReadScenario(folder->path() / "none.yaml", problems);
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, base::ErrorCode::kNotFound);
}

}  // namespace
}  // namespace gsv::scenario
