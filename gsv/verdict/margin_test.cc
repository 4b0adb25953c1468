#include "gsv/verdict/margin.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gsv/scenario/scenario_file.h"

namespace gsv::verdict {
namespace {

using namespace std::chrono_literals;
using ::testing::IsEmpty;
using ::testing::SizeIs;

scenario::Formula FormulaOf(const std::string& expect) {
  base::Problems problems;
  const auto scenario =
      scenario::ParseScenario("duration: 8\nexpect:\n  - " + expect + "\n", "t.yaml", problems);
  EXPECT_TRUE(scenario && problems.empty()) << expect;
  return scenario->expect.at(0).formula;
}

simulation::ExpectationState Noted(const std::string& expect,
                                   const std::vector<std::vector<std::optional<double>>>& states) {
  auto margin = MarginOf(FormulaOf(expect));
  EXPECT_TRUE(margin) << expect;
  simulation::ExpectationState state;
  base::SimTime now = 0s;
  for (const auto& values : states) {
    margin->Note(now, values);
    now += 1s;
  }
  margin->Fill(state);
  return state;
}

TEST(Margin, IsTheSmallestDistanceForAlways) {
  const auto state = Noted("{distance_at_least: {between: [a, b], metres: 2}}",
                           {{3.0}, {2.5}, {std::nullopt}, {2.75}});
  EXPECT_DOUBLE_EQ(state.margin.value(), 0.5);
  EXPECT_EQ(state.margin_at, 1s);
  EXPECT_EQ(state.unit, "m");
}

TEST(Margin, IsNegativeBeyondTheLimit) {
  const auto state = Noted("{always: {speed: {robot: a, at_most: 1}}}", {{0.0}, {1.5}, {0.0}});
  EXPECT_DOUBLE_EQ(state.margin.value(), -0.5);
  EXPECT_EQ(state.unit, "m/s");
}

TEST(Margin, IsTheLargestDistanceForEventually) {
  // A robot has reached a place if it is within 0.25 m.
  const auto state = Noted("{reaches: {robot: a, x: 1, y: 0}}", {{2.0}, {0.75}, {1.0}});
  EXPECT_DOUBLE_EQ(state.margin.value(), -0.5);
  EXPECT_EQ(state.margin_at, 1s);
}

TEST(Margin, IsTheSmallestDistanceAmongTheNumbersOfACondition) {
  const auto state =
      Noted("{stays_within: {robot: a, x: [0, 4], y: [-1, 1]}}", {{2.0, 0.0}, {2.0, 0.75}});
  EXPECT_DOUBLE_EQ(state.margin.value(), 0.25);
}

TEST(Margin, IsTheRemainingTimeForNeverStuck) {
  const auto state = Noted("{never: {stuck: {robot: a, after: 5}}}", {{0.0}, {3.5}, {0.0}});
  EXPECT_DOUBLE_EQ(state.margin.value(), 1.5);
  EXPECT_EQ(state.unit, "s");
}

// A lidar reads infinity where nothing is, and -infinity below its smallest range.
TEST(Margin, OfASensorWithInfiniteValuesIsThatOfTheOthers) {
  const double infinity = std::numeric_limits<double>::infinity();
  const auto state = Noted("{always: {sensor: {of: a/lidar, at_most: 2}}}", {{-infinity}, {1.5}});
  EXPECT_DOUBLE_EQ(state.margin.value(), 0.5);
  const auto both = Noted(
      "{always: {all: [{sensor: {of: a/lidar, at_most: 2}}, {speed: {robot: a, at_most: 1}}]}}",
      {{-infinity, 0.25}});
  EXPECT_DOUBLE_EQ(both.margin.value(), 0.75);
}

TEST(Margin, IsMeasuredInsideTheWindowOnly) {
  const auto state = Noted("{always: {speed: {robot: a, at_most: 1}}, from: 1, by: 2}",
                           {{9.0}, {0.5}, {0.25}, {9.0}});
  EXPECT_DOUBLE_EQ(state.margin.value(), 0.5);
}

TEST(Margin, ContactAndBeforeExpectationsHaveNoMargin) {
  EXPECT_FALSE(MarginOf(FormulaOf("{never_collides: a}")));
  EXPECT_FALSE(MarginOf(FormulaOf("{before: [{contact: a}, {contact: b}]}")));
}

TEST(Shapes, ReachesIsACircleAndStaysWithinIsABox) {
  simulation::ExpectationState state;
  AddShapes(FormulaOf("{reaches: {robot: a, x: 1, y: 2, within: 0.5}}"), state);
  ASSERT_THAT(state.places, SizeIs(1));
  EXPECT_EQ(state.places[0].x, 1);
  EXPECT_EQ(state.places[0].y, 2);
  EXPECT_EQ(state.places[0].radius, 0.5);
  EXPECT_THAT(state.boxes, IsEmpty());
  AddShapes(FormulaOf("{stays_within: {robot: a, x: [0, 4]}}"), state);
  ASSERT_THAT(state.boxes, SizeIs(1));
  EXPECT_EQ(state.boxes[0].x_max, 4);
  EXPECT_EQ(state.boxes[0].y_max, std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace gsv::verdict
