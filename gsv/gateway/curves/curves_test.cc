#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "gsv/gateway/curves/field_value.h"
#include "gsv/gateway/curves/recorded_curves.h"
#include "gsv/messages/sensor_msgs.h"
#include "gsv/recording/testing/test_recording.h"

namespace gsv::gateway::curves {
namespace {

using recording::operator""ms;
using nlohmann::ordered_json;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(CurvePoints, KeepsEverySampleWhileThereIsSpace) {
  CurvePoints points(0ms, 100ms, 4);
  for (const double value : {1.0, 2.0, kInfinity, 3.0}) {
    points.Add(points.samples() * 10ms, value);
  }
  EXPECT_TRUE(points.is_whole());
  const std::vector<Point> expected{{0ms, 1}, {10ms, 2}, {20ms, kInfinity}, {30ms, 3}};
  EXPECT_EQ(points.Points(), expected);
}

TEST(CurvePoints, KeepsSpikesWhenThereIsNoSpace) {
  CurvePoints points(0ms, 999ms, 20);
  for (int i = 0; i < 1000; ++i) {
    points.Add(i * 1ms, i == 543 ? 100.0 : i == 544 ? -100.0 : std::sin(i * 0.01));
  }
  EXPECT_FALSE(points.is_whole());
  EXPECT_EQ(points.samples(), 1000u);
  const std::vector<Point> kept = points.Points();
  EXPECT_LE(kept.size(), 20u);
  EXPECT_EQ(std::count(kept.begin(), kept.end(), Point{543ms, 100}), 1);
  EXPECT_EQ(std::count(kept.begin(), kept.end(), Point{544ms, -100}), 1);
  for (std::size_t i = 1; i < kept.size(); ++i) EXPECT_LT(kept[i - 1].time, kept[i].time);
}

TEST(CurvePoints, KeepsOnePointOfABinWithoutFiniteSamples) {
  CurvePoints points(0ms, 100ms, 4);
  for (int i = 0; i < 100; ++i) points.Add(i * 1ms, i < 50 ? 2 : kInfinity);
  const std::vector<Point> expected{{0ms, 2}, {50ms, kInfinity}};
  EXPECT_EQ(points.Points(), expected);
}

TEST(CurvePoints, StaysBoundedForAnySampleTimes) {
  CurvePoints points(50ms, 10ms, 10);
  for (int i = 0; i < 100; ++i) points.Add((i % 7 - 3) * 1'000'000ms, i);
  EXPECT_LE(points.Points().size(), 10u);
}

TEST(FieldValue, FindsTheValuesThatTheViewerLists) {
  const ordered_json message = ordered_json::parse(R"({
    "range": 1.5, "touched": true, "text": "2", "none": [],
    "pose": {"position": {"x": 3, "y": 4, "z": 5},
             "orientation": {"x": 0, "y": 0, "z": 0.7071067811865476, "w": 0.7071067811865476}},
    "short": [1, 2, 3], "long": [5, 1, 9, 3, 7, 2, 8, 4, 6],
    "name": ["left", "right"], "position": [0.25, -0.5],
    "boxes": [{"size": 7}, {"size": 8}]})");
  const std::pair<const char*, double> expected[] = {
      {"range", 1.5},
      {"touched", 1},
      {"pose.position.y", 4},
      {"pose.orientation.yaw", std::acos(0)},
      {"pose.orientation.roll", 0},
      {"short[2]", 3},
      {"long.min", 1},
      {"long.max", 9},
      {"long.mean", 5},
      {"position[right]", -0.5},
      {"boxes.count", 2},
      {"boxes[0].size", 7},
      {"none.count", 0},
  };
  for (const auto& [key, value] : expected) {
    const auto found = FieldValue(message, key);
    ASSERT_TRUE(found) << key;
    EXPECT_NEAR(*found, value, 1e-12) << key;
  }
  for (const char* key :
       {"", ".", "[", "text", "range.x", "pose", "short[3]", "short[-1]", "short[", "short[1",
        "short[18446744073709551616]", "long[1]", "long.", "long.median", "position[up]",
        "boxes[1].size", "boxes[0]", "pose.orientation.yaws", "none[0]"}) {
    EXPECT_FALSE(FieldValue(message, key)) << key;
  }
}

TEST(FieldValue, OmitsNonFiniteValues) {
  ordered_json message;
  message["ranges"] = ordered_json::array();
  for (int i = 0; i < 9; ++i) message["ranges"].push_back(i == 4 ? 2.5 : kInfinity);
  EXPECT_EQ(FieldValue(message, "ranges.min"), 2.5);
  EXPECT_EQ(FieldValue(message, "ranges.mean"), 2.5);
  message["ranges"][4] = NAN;
  EXPECT_TRUE(std::isnan(FieldValue(message, "ranges.min").value()));
}

// Returns a recording of ten seconds in chunks of 0.1 s. The ranges begin at 1 m and increase by 1
// mm every 10 ms.
recording::Bytes TenSeconds() {
  recording::Bytes bytes;
  recording::MemorySink sink(bytes);
  recording::McapFileWriter writer(sink, {});
  const messages::Schema& schema = messages::SchemaOf<messages::sensor_msgs::Range>();
  EXPECT_TRUE(writer.AddSchema(
      {1, std::string(schema.name), std::string(schema.encoding), std::string(schema.text)}));
  EXPECT_TRUE(writer.AddChannel({0, 1, "/robot/sonar", "cdr", {}}));
  for (int i = 0; i < 1000; ++i) {
    messages::sensor_msgs::Range message;
    message.range = 1 + 0.001f * static_cast<float>(i);
    recording::Bytes data;
    messages::Encode(message, data);
    EXPECT_TRUE(writer.Write({0, 0, i * 10ms, i * 10ms, data}));
    if (i % 10 == 9) (void)writer.Flush();
  }
  EXPECT_TRUE(writer.Close());
  return bytes;
}

class RecordedCurvesTest : public ::testing::Test {
 protected:
  // Requests the curve repeatedly until it was read completely.
  static Curve Whole(RecordedCurves& curves, const CurveRequest& request) {
    for (;;) {
      auto curve = curves.Get(request).value();
      if (curve.is_done) return curve;
      std::this_thread::yield();
    }
  }

  const recording::Bytes bytes_ = TenSeconds();
  const std::unique_ptr<recording::McapReader> reader_ = recording::Open(bytes_).value();
  const RecordedScene scene_{*reader_};
};

TEST_F(RecordedCurvesTest, ReadsAllSamplesOfAShortCurve) {
  RecordedCurves curves(*reader_, scene_);
  const Curve curve =
      Whole(curves, {.topic = "/robot/sonar", .robot = {}, .key = "range", .max_points = 1000});
  ASSERT_EQ(curve.points.size(), 1000u);
  EXPECT_TRUE(curve.is_whole);
  EXPECT_EQ(curve.read_to, 9990ms);
  EXPECT_EQ(curve.problem, "");
  EXPECT_EQ(curve.points[250].time, 2500ms);
  EXPECT_NEAR(curve.points[250].value, 1.25, 1e-6);
}

TEST_F(RecordedCurvesTest, ReducesALongCurveOverItsWholeLength) {
  RecordedCurves curves(*reader_, scene_);
  const Curve curve =
      Whole(curves, {.topic = "/robot/sonar", .robot = {}, .key = "range", .max_points = 50});
  EXPECT_FALSE(curve.is_whole);
  EXPECT_EQ(curve.samples, 1000u);
  ASSERT_EQ(curve.points.size(), 50u);
  EXPECT_EQ(curve.points.front().time, 0ms);
  EXPECT_EQ(curve.points.back().time, 9990ms);
  for (const Point& point : curve.points) {
    EXPECT_NEAR(point.value, 1 + 0.1 * base::ToSeconds(point.time), 1e-6);
  }
}

TEST_F(RecordedCurvesTest, EndsAtItsTimeLimitAndReportsIt) {
  RecordedCurves curves(*reader_, scene_, std::chrono::milliseconds(-1));
  const Curve curve =
      Whole(curves, {.topic = "/robot/sonar", .robot = {}, .key = "range", .max_points = 1000});
  EXPECT_LT(curve.points.size(), 1000u);
  EXPECT_NE(curve.problem.find("too long"), std::string::npos) << curve.problem;
}

TEST_F(RecordedCurvesTest, CachesAFewCurvesAndReadsOthersAgain) {
  RecordedCurves curves(*reader_, scene_);
  for (std::size_t max_points = 2; max_points < 60; ++max_points) {
    (void)curves.Get(
        {.topic = "/robot/sonar", .robot = {}, .key = "range", .max_points = max_points});
  }
  EXPECT_EQ(Whole(curves, {.topic = "/robot/sonar", .robot = {}, .key = "range", .max_points = 2})
                .samples,
            1000u);
}

TEST_F(RecordedCurvesTest, RefusesMissingTopicsAndValues) {
  RecordedCurves curves(*reader_, scene_);
  const auto code = [&](const CurveRequest& request) {
    const auto curve = curves.Get(request);
    return curve ? std::optional<base::ErrorCode>() : curve.error().code;
  };
  using enum base::ErrorCode;
  EXPECT_EQ(code({"/other", "", "range", 10}), kNotFound);
  EXPECT_EQ(code({"", "robot", "x", 10}), kNotFound);  // no scene, so no robots
  EXPECT_EQ(code({"", "robot", "mood", 10}), kInvalidArgument);
  EXPECT_EQ(code({"", "", "mood", 10}), kInvalidArgument);
  EXPECT_EQ(code({"", "", "late_steps", 10}), kNotFound);
  EXPECT_EQ(code({"/robot/sonar", "robot", "range", 10}), kInvalidArgument);
  EXPECT_EQ(code({"/robot/sonar", "", "", 10}), kInvalidArgument);
  EXPECT_EQ(code({"/robot/sonar", "", "range", 1}), kInvalidArgument);
  EXPECT_EQ(code({"/robot/sonar", "", "range", 100'001}), kInvalidArgument);
  curves.Stop();
  EXPECT_EQ(code({"/robot/sonar", "", "range", 10}), kUnavailable);
}

}  // namespace
}  // namespace gsv::gateway::curves
