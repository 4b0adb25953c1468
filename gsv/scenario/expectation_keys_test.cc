// Tests the keys `faults` and `expect`.
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gsv/scenario/scenario_file.h"

namespace gsv::scenario {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<std::string> ProblemsInKeys(const std::string& text) {
  base::Problems problems;
  const auto scenario = ParseScenario(text, "t.yaml", problems);
  if (!scenario) return {scenario.error().Sentence()};
  std::vector<std::string> sentences;
  for (const base::Problem& problem : problems) sentences.push_back(problem.Sentence());
  return sentences;
}

Scenario ReadWhole(const std::string& text) {
  base::Problems problems;
  const auto scenario = ParseScenario(text, "t.yaml", problems);
  EXPECT_TRUE(scenario) << scenario.error().Sentence();
  EXPECT_THAT(ProblemsInKeys(text), IsEmpty());
  return scenario.value_or(Scenario());
}

constexpr const char* kEverything = R"(
duration: 60
faults:
  - {at: 5, sensor: scout/front}
  - {at: 5.5, sensor: scout/front, fails: error}
  - {at: 6, behaviour: scout}
  - {at: 7, motor: scout}
  - {at: 7, motor: arm/shoulder}
  - {at: 8, move: crate, x: 1, y: -2, yaw: 90deg}
  - {at: 8, move: crate, x: 0.1, y: 0, z: 2}
  - {at: 9, joint: gate/hinge, position: 1.5}
  - {at: 9, joint: gate/hinge, effort: -3}
expect:
  - reaches: {robot: scout, x: 3, y: 0, within: 0.5, yaw: 0, yaw_within: 10deg}
    by: 30
    name: "there in time: #1"
  - stays_within: {robot: scout, x: [-5, 5], y: [-4, 4.5]}
  - never_collides: scout
  - never_collides: [scout, "odd, name"]
  - {distance_at_least: {between: [scout, tall], metres: 0.4}, from: 2, by: 40}
  - before: [{near: {robot: scout, x: 1, y: 1}}, {ended: tall}]
  - always:
      implies:
        - sensor: {of: scout/front, at_most: 0.5}
        - eventually: {speed: {robot: scout, at_most: 0.1}}
          by: 2
  - until: [{not: {contact: scout}}, {time: {at_least: 10}}]
  - any: [{travelled: {robot: scout, at_least: 3}}, {turning: {robot: scout, at_least: 1}}]
  - all:
      - eventually: {sensor: {of: scout/battery, value: 4, at_least: 0.2, at_most: 1}}
      - eventually: {distance: {between: [a, b], at_most: 1}}
)";

TEST(TestKeys, EveryKeyIsReadAndWrittenBack) {
  const Scenario scenario = ReadWhole(kEverything);
  ASSERT_EQ(scenario.faults.size(), 9u);
  EXPECT_EQ(scenario.faults[0].body, "scout");
  EXPECT_EQ(scenario.faults[0].part, "front");
  EXPECT_EQ(scenario.faults[1].kind, Fault::Kind::kSensorError);
  EXPECT_EQ(scenario.faults[4].part, "shoulder");
  EXPECT_EQ(scenario.faults[6].place, (Place{0.1, 0, 2, 0}));
  EXPECT_EQ(scenario.faults[8].unit, Fault::Unit::kEffort);
  EXPECT_EQ(scenario.faults[8].target, -3);
  EXPECT_EQ(scenario.faults[5].source.text, "t.yaml:9:5");
  ASSERT_EQ(scenario.expect.size(), 10u);
  EXPECT_EQ(scenario.expect[0].name, "there in time: #1");
  EXPECT_EQ(scenario.expect[0].formula.kind, Formula::Kind::kEventually);
  EXPECT_EQ(scenario.expect[0].formula.by, 30);
  EXPECT_EQ(scenario.expect[2].name, "{never_collides: scout}");
  const Scenario again = ReadWhole(ToYaml(scenario));
  EXPECT_EQ(again, scenario) << ToYaml(scenario);
  EXPECT_EQ(again.expect[0].name, "there in time: #1");
}

TEST(TestKeys, ASensorWithoutABoundMayReadInfinity) {
  const Scenario scenario =
      ReadWhole("duration: 1\nexpect:\n  - always: {sensor: {of: scout/lidar, at_least: 0.3}}\n");
  const Formula& atom = scenario.expect.at(0).formula.parts.at(0);
  EXPECT_EQ(atom.min, 0.3);
  EXPECT_EQ(atom.max, std::numeric_limits<double>::infinity());
}

TEST(TestKeys, ErrorsInFaultsAreReportedWithTheirPlace) {
  EXPECT_THAT(
      ProblemsInKeys("faults:\n"
                     "  - {sensor: scout/front}\n"
                     "  - {at: 1, sensor: scout}\n"
                     "  - {at: 1, behaviour: scout/front}\n"
                     "  - {at: 1, sensor: a/b, motor: a}\n"
                     "  - {at: 1}\n"
                     "  - {at: 1, move: crate, x: 1}\n"
                     "  - {at: 1, joint: gate/hinge}\n"
                     "  - {at: -1, motor: a, fails: error}\n"),
      ElementsAre(
          "t.yaml:2:5: the fault needs a time: set at, in seconds",
          "t.yaml:3:21: sensor must be as in ROBOT/sensor",
          "t.yaml:4:24: behaviour must be one name, found \"scout/front\"",
          "t.yaml:5:5: a fault needs exactly one of these keys: sensor, behaviour, motor, move, "
          "joint",
          "t.yaml:6:5: a fault needs exactly one of these keys: sensor, behaviour, motor, move, "
          "joint",
          "t.yaml:7:5: a place needs both x and y",
          "t.yaml:8:5: give exactly one of 'position', 'velocity' and 'effort' for the joint",
          "t.yaml:9:10: at must be a number from 0 to 1e+09, found \"-1\"",
          HasSubstr("t.yaml:9:24: there is no key \"fails\" here; the known keys are at, sensor")));
}

TEST(TestKeys, ErrorsInExpectationsAreReportedWithTheirPlace) {
  EXPECT_THAT(
      ProblemsInKeys("duration: 10\n"
                     "expect:\n"
                     "  - {never: scout}\n"
                     "  - {newer: scout}\n"
                     "  - {never_collides: scout, ended: scout}\n"
                     "  - {speed: {robot: scout, at_most: 1}, by: 3}\n"
                     "  - {eventually: {speed: {robot: a}}, by: 11}\n"
                     "  - {always: {speed: {robot: a, at_least: 2, at_most: 1}}, from: 5, by: 4}\n"
                     "  - {before: [{ended: a}]}\n"
                     "  - {inside: {robot: a, x: [2, 1]}}\n"
                     "  - {reaches: {x: 1, y: 2}}\n"
                     "  - {distance: {between: [a, a], at_most: 1}}\n"
                     "  - {sensor: {of: scout, take: median, at_most: 1}}\n"),
      ElementsAre("t.yaml:3:13: never must be stuck or a condition, as in never: {contact: scout}",
                  HasSubstr("t.yaml:4:5: a condition has one operator of reaches, "),
                  HasSubstr("t.yaml:4:6: there is no key \"newer\" here"),
                  "t.yaml:5:36: a condition has exactly one operator, found never_collides "
                  "and ended",
                  HasSubstr("t.yaml:6:45: 'from' and 'by' belong to expectations about time only"),
                  "t.yaml:7:26: set at_least, at_most or both",
                  "t.yaml:7:43: 'by' is after the end of the run (duration)",
                  "t.yaml:8:55: at_most is less than at_least",
                  HasSubstr("t.yaml:8:73: 'by' is before 'from'"),
                  "t.yaml:9:14: before must be a list of 2 conditions",
                  HasSubstr("t.yaml:10:28: x must be two numbers"),
                  "t.yaml:11:15: set robot to the name of a robot or an object",
                  "t.yaml:12:26: between must be two names, as in [scout, crate]",
                  "t.yaml:13:19: of must be a sensor, as in scout/front",
                  "t.yaml:13:32: take must be min, max or mean, found \"median\""));
  EXPECT_THAT(ProblemsInKeys("expect: [{ended: a}]"),
              ElementsAre("t.yaml:1:9: expectations need an end of the run: set duration"));
}

TEST(TestKeys, AtMostAThousandFaultsAndExpectationsAreAccepted) {
  std::string faults = "duration: 60\nfaults:\n", expect = "duration: 60\nexpect:\n";
  for (int i = 0; i < 1000; ++i) {
    faults += "  - {at: 5, behaviour: r}\n";
    expect += "  - {ended: r}\n";
  }
  EXPECT_EQ(ReadWhole(faults).faults.size(), 1000u);
  EXPECT_THAT(ProblemsInKeys(faults + "  - {at: 5, behaviour: r}\n"),
              ElementsAre(HasSubstr("faults has at most 1000 entries")));
  EXPECT_THAT(ProblemsInKeys(expect), IsEmpty());
  EXPECT_THAT(ProblemsInKeys(expect + "  - {ended: r}\n"),
              ElementsAre(HasSubstr("expect has at most 1000 entries")));
}

TEST(TestKeys, AliasesCannotExpandToALargeFormula) {
  std::string text = "duration: 1\nexpect:\n  - all: [&a0 {ended: r}]\n";
  for (int i = 1; i < 30; ++i) {
    const std::string before = "*a" + std::to_string(i - 1);
    text += "  - &a" + std::to_string(i) + " {all: [" + before + ", " + before + "]}\n";
  }
  EXPECT_THAT(
      ProblemsInKeys(text),
      ::testing::Contains(HasSubstr("the expectations have more than 1000 conditions in total")));
}

}  // namespace
}  // namespace gsv::scenario
