#include "gsv/verdict/judge.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gsv/scenario/scenario_file.h"
#include "gsv/simulation/testing/test_simulation.h"

namespace gsv::verdict {
namespace {

using namespace gsv::simulation;
using ::testing::HasSubstr;

scenario::Scenario ScenarioOf(const std::string& expect, const std::string& more = "") {
  base::Problems problems;
  auto scenario =
      scenario::ParseScenario("duration: 8\n" + more + "expect:\n" + expect, "t.yaml", problems);
  EXPECT_TRUE(scenario && problems.empty())
      << (scenario ? problems.at(0).Sentence() : scenario.error().Sentence());
  return scenario.value_or(scenario::Scenario());
}

// A disc with a radius of 0.2 m drives at 0.5 m/s from x = 0 to a wall whose face is at x = 2.9 m.
// A second disc stands at (0, 2).
std::vector<Finding> Judged(const std::string& expect, const std::string& more = "") {
  const scenario::Scenario scenario = ScenarioOf(expect, more);
  Specification specification = Lockstep(8s);
  specification.faults = scenario.faults;
  const auto simulation = Make(std::move(specification));
  EXPECT_TRUE(simulation->AddRobot(Robot("scout", 0, 0, Drives(0.5))));
  EXPECT_TRUE(simulation->AddRobot(Robot("tall", 0, 2)));
  const auto judge = Judge::Attach(scenario.expect, *simulation);
  EXPECT_TRUE(judge) << judge.error().Sentence();
  RunToEnd(*simulation);
  return (*judge)->Finish();
}

Finding One(const std::string& expect, const std::string& more = "") {
  return Judged("  - " + expect + "\n", more).at(0);
}

TEST(Judge, RobotReachesAPlaceWithinTheTolerance) {
  // At 2 s, the disc is within 0.25 m of x = 1.25 m.
  const Finding reaches = One("{reaches: {robot: scout, x: 1.25, y: 0}, by: 3}");
  EXPECT_TRUE(reaches.holds);
  EXPECT_NEAR(base::ToSeconds(reaches.time), 2, 0.011);
  const Finding late = One("{reaches: {robot: scout, x: 1.25, y: 0}, by: 1.9}");
  EXPECT_FALSE(late.holds);
  EXPECT_EQ(late.time, 1900ms);
  EXPECT_THAT(late.Sentence(),
              HasSubstr("violated at 1.9 s (step 190): the distance of scout "
                        "from (1.25, 0) was 0.3 m (at most 0.25; it ranged from "));
  EXPECT_FALSE(One("{reaches: {robot: scout, x: 1.25, y: 0, yaw: 90deg}}").holds);
}

TEST(Judge, CollisionIsTheFirstContact) {
  // The disc touches the wall when its centre is at x = 2.7 m, at 5.4 s.
  const Finding collides = One("{never_collides: scout}");
  EXPECT_FALSE(collides.holds);
  EXPECT_NEAR(base::ToSeconds(collides.time), 5.4, 0.021);
  EXPECT_TRUE(One("{never_collides: scout, by: 5}").holds);
  EXPECT_TRUE(One("{never_collides: [scout, tall]}").holds);
  EXPECT_TRUE(One("{eventually: {contact: [wall, scout]}}").holds);
  EXPECT_TRUE(One("{stays_within: {robot: scout, x: [0, 2.71], y: [-0.1, 0.1]}}").holds);
}

TEST(Judge, MeasuresTheNumbersOfTheState) {
  const auto findings = Judged(
      "  - {distance_at_least: {between: [scout, tall], metres: 2}}\n"
      "  - {distance_at_least: {between: [scout, tall], metres: 2.001}}\n"
      "  - {always: {speed: {robot: scout, at_most: 0.51}}}\n"
      "  - {eventually: {travelled: {robot: scout, at_least: 2.6}}, by: 5.3}\n"
      "  - {before: [{near: {robot: scout, x: 1, y: 0}}, {contact: scout}]}\n"
      "  - {before: [{contact: scout}, {near: {robot: scout, x: 1, y: 0}}]}\n"
      "  - {until: [{sensor: {of: scout/front, at_least: 1}}, {time: {at_least: 3.5}}]}\n"
      "  - {always: {not: {ended: scout}}}\n");
  const bool holds[]{true, false, true, true, true, false, true, true};
  for (std::size_t i = 0; i < findings.size(); ++i) {
    EXPECT_EQ(findings[i].holds, holds[i]) << findings[i].yaml << " " << findings[i].Sentence();
  }
  EXPECT_EQ(findings[1].step, 0);
}

TEST(Judge, SeesFaultsAtTheirInstant) {
  const std::string dies = "faults: [{at: 2, behaviour: scout}]\n";
  const Finding ended = One("{eventually: {ended: scout}}", dies);
  EXPECT_TRUE(ended.holds);
  EXPECT_NEAR(base::ToSeconds(ended.time), 2, 0.06);
  EXPECT_TRUE(One("{never_collides: scout}", dies).holds);
  const std::string silent = "faults: [{at: 2, sensor: scout/front}]\n";
  // After the fault, the sensor keeps its last reading: 1.9 m to the wall.
  EXPECT_TRUE(
      One("{always: {sensor: {of: scout/front, at_least: 1.89, at_most: 1.91}}, from: 2.01}",
          silent)
          .holds);
  const std::string error = "faults: [{at: 2, sensor: scout/front, fails: error}]\n";
  const Finding lost = One("{always: {sensor: {of: scout/front, at_least: 0}}}", error);
  EXPECT_FALSE(lost.holds);
  EXPECT_EQ(lost.time, 2010ms);
}

TEST(Judge, RobotIsStuckAfterItWasCommandedToMoveForTheGivenTime) {
  // The disc stops at the wall at 5.4 s. Its motion is sampled every 0.1 s.
  const Finding stuck = One("{never: {stuck: {robot: scout, after: 2}}}");
  EXPECT_FALSE(stuck.holds);
  EXPECT_NEAR(base::ToSeconds(stuck.time), 7.4, 0.21);
  EXPECT_THAT(stuck.Sentence(),
              HasSubstr("scout was stuck: it was commanded to move for 2 s and did not"));
  EXPECT_TRUE(One("{never: {stuck: {robot: tall, after: 2}}}").holds) << "nobody commands it";
  EXPECT_TRUE(One("{never: stuck}").holds) << "the run ends before the 5 s";
  const Finding any = One("{never: {stuck: {after: 2}}}");
  EXPECT_FALSE(any.holds);
  EXPECT_EQ(any.time, stuck.time);
  EXPECT_THAT(any.Sentence(), HasSubstr("scout was stuck"));
  EXPECT_TRUE(One("{eventually: {stuck: {robot: scout, after: 2}}}").holds);
}

TEST(Judge, ReportsTheStateOfEachExpectationDuringTheRun) {
  const auto scenario = ScenarioOf(
      "  - {name: hits nothing, never_collides: scout}\n"
      "  - {name: arrives, reaches: {robot: scout, x: 1.25, y: 0}}\n"
      "  - {name: is quick, eventually: {speed: {robot: scout, at_least: 9}}}\n");
  const auto simulation = Make(Lockstep(8s));
  ASSERT_TRUE(simulation->AddRobot(Robot("scout", 0, 0, Drives(0.5))));
  const auto judge = Judge::Attach(scenario.expect, *simulation);
  ASSERT_TRUE(judge);
  using Verdict = ExpectationState::Verdict;
  auto states = simulation->expectations();
  ASSERT_EQ(states.size(), 3u);
  EXPECT_EQ(states[0].verdict, Verdict::kPending);
  RunToEnd(*simulation);
  (void)(*judge)->Finish();
  states = simulation->expectations();
  EXPECT_EQ(states[0].verdict, Verdict::kViolated);
  EXPECT_EQ(states[0].bodies, std::vector<std::string>{"scout"});
  EXPECT_EQ(states[1].verdict, Verdict::kHolds);
  EXPECT_GE(states[1].margin.value(), 0);
  EXPECT_LT(states[1].margin.value(), 0.01);
  EXPECT_EQ(states[2].verdict, Verdict::kViolated);
  std::vector<std::string> events;
  for (const Event& event : simulation->events(0)) {
    if (event.kind.starts_with("expectation")) events.push_back(event.kind + " " + event.robot);
  }
  EXPECT_EQ(events, (std::vector<std::string>{"expectation_held ", "expectation_violated scout",
                                              "expectation_violated scout"}));
}

TEST(Judge, MissingRobotOrSensorIsAnErrorWithItsPlace) {
  const auto simulation = Make(Lockstep(1s));
  ASSERT_TRUE(simulation->AddRobot(Robot("scout", 0, 0)));
  const std::pair<const char*, const char*> refused[]{
      {"{never_collides: marvin}", "t.yaml:3:5: there is no body in the world with the name"},
      {"{always: {sensor: {of: scout/nose, at_least: 1}}}", "has no sensor \"nose\""},
      {"{eventually: {ended: wall}}", "\"wall\" is not a robot"},
      {"{distance_at_least: {between: [scout, b], metres: 1}}", "with the name \"b\""}};
  for (const auto& [expect, sentence] : refused) {
    const auto judge =
        Judge::Attach(ScenarioOf(std::string("  - ") + expect + "\n").expect, *simulation);
    ASSERT_FALSE(judge) << expect;
    EXPECT_EQ(judge.error().code, base::ErrorCode::kBadModel);
    EXPECT_THAT(judge.error().Sentence(), HasSubstr(sentence));
  }
}

}  // namespace
}  // namespace gsv::verdict
