// Tests comparisons and fits with small logs whose errors are known.
#include "gsv/reality/comparison.h"

#include <cmath>

#include <gmock/gmock.h>

#include "gsv/base/test_within.h"
#include "gsv/geometry/constants.h"
#include "gsv/reality/radio_comparison.h"
#include "gsv/reality/world_fit.h"

namespace gsv::reality {
namespace {

using testing::HasSubstr;

// The log of a tag that passes an anchor at the origin, along the x axis.
Log RangesOf(double bias, double bias_per_metre) {
  Log log;
  log.truth_has_yaw = false;
  for (int i = 0; i < 100; ++i) {
    const double time = 0.039 * i, distance = 1 + 0.05 * i;
    log.truth.push_back({time, distance, 0, 0});
    log.radio.push_back({time, 7, distance * (1 + bias_per_metre) + bias, distance, 0, 0});
  }
  return log;
}

TEST(Comparison, RefusesALogWithoutScans) {
  Log log;
  log.beam_angles = {0};
  log.max_range = 5;
  log.scans = {{0.5, {1.0}, TimedPose{}}, {1.5, {1.0}, TimedPose{}}};
  const auto comparison = Compare(log, {});
  ASSERT_FALSE(comparison);
  EXPECT_THAT(comparison.error().Sentence(), HasSubstr("the log is too short"));
  const auto empty = Compare(Log(), {});
  ASSERT_FALSE(empty);
  EXPECT_THAT(empty.error().Sentence(), HasSubstr("the log has nothing to compare"));
}

// A robot in a room of 4 by 4 m. The log's poses are right or, if `is_lost`, two metres wrong in
// every second block.
Log InARoom(bool is_lost) {
  Log log;
  log.max_range = 10;
  for (int i = -8; i <= 8; ++i) log.beam_angles.push_back(0.1 * i);
  for (int i = 0; i < 160; ++i) {
    RangeScan scan{0.1 * i, {}, TimedPose{0.1 * i, 0.005 * i, 0, 0}};
    for (const double angle : log.beam_angles)
      scan.ranges.push_back((2 - scan.base->x) / std::cos(angle));
    if (is_lost && i / 40 % 2 == 1) scan.base->x -= 2;
    log.scans.push_back(std::move(scan));
  }
  return log;
}

TEST(Comparison, WarnsAboutPosesThatDoNotFitTheWorld) {
  const auto right = Compare(InARoom(false), {}), lost = Compare(InARoom(true), {});
  ASSERT_TRUE(right && lost);
  EXPECT_EQ(right->warning, "");
  EXPECT_THAT(lost->warning, HasSubstr("Give a map of the place with --world"));
}

TEST(Comparison, RefusesParametersThatNoDeviceOfTheLogHas) {
  CompareOptions options;
  options.parameters = {{"noise.stdev", 0.1}};
  const auto refused = Compare(InARoom(false), options);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, base::ErrorCode::kInvalidArgument);
  EXPECT_THAT(
      refused.error().message,
      HasSubstr("devices (lidar) have no parameter \"noise.stdev\". Did you mean noise.stddev?"));
  EXPECT_FALSE(Fit(InARoom(false), options));
  options.parameters = {{"noise.stddev", 0.1}, {"range_noise", 0.01}};
  EXPECT_TRUE(Compare(InARoom(false), options));
}

TEST(Comparison, RefusesADeviceWithFewerBeamsThanTheLog) {
  CompareOptions options;
  options.parameters = {{"scan.horizontal.resolution", 0.5}};
  const auto refused = Compare(InARoom(false), options);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("the log has 17"));
}

// A robot that drives straight ahead at 0.1 m/s, seen by a reference system from `begin` to `end`.
// Its odometry is a quarter too long, in a frame of its own that is rotated by a right angle.
Log StraightAhead(double begin, double end) {
  Log log;
  for (int i = 0; i <= 400; ++i) {
    const double time = 0.1 * i;
    log.odometry.push_back({time, 3, 0.125 * time, geometry::kPi / 2});
    if (time >= begin && time <= end) log.truth.push_back({time, 0.1 * time, 1, 0});
  }
  return log;
}

double RealValue(const Comparison& comparison, const std::string& what) {
  for (const Row& row : comparison.rows) {
    if (row.what == what) return row.real;
  }
  return std::nan("");
}

TEST(Comparison, AlignsOdometryAndReferenceAtTheirFirstCommonInstant) {
  for (const double begin : {0.0, 0.45, 10.05}) {
    const auto comparison = Compare(StraightAhead(begin, 30.01), {});
    ASSERT_TRUE(comparison) << comparison.error().Sentence();
    const double first = begin == 0 ? 0 : begin + 0.05;
    EXPECT_WITHIN(RealValue(*comparison, "error at the end"), 0.025 * (30 - first), 1e-9, "m");
    EXPECT_WITHIN(RealValue(*comparison, "true distance / estimated distance"), 0.8, 1e-6, "");
    EXPECT_EQ(comparison->warning, "");
  }
}

TEST(Comparison, OfAShortLogHasNoStatisticsOfTheOdometry) {
  const Log log = StraightAhead(0, 4.01);
  const auto comparison = Compare(log, {});
  ASSERT_TRUE(comparison) << comparison.error().Sentence();
  EXPECT_EQ(comparison->rows.size(), 1u);
  EXPECT_WITHIN(RealValue(*comparison, "error at the end"), 0.1, 1e-9, "m");
  EXPECT_THAT(comparison->warning,
              HasSubstr("the log is too short for statistics of the odometry"));
  const auto fitted = Fit(log, {});
  ASSERT_FALSE(fitted);
  EXPECT_THAT(fitted.error().message, HasSubstr("the log is too short to fit odometry"));
}

TEST(WorldFit, ReachesAsFarAsTheEchoes) {
  Log log;
  log.max_range = 80;
  log.beam_angles = {0};
  for (int i = 0; i < 20; ++i) log.scans.push_back({0.1 * i, {30.0}, TimedPose{0.1 * i, 0, 0, 0}});
  const auto map = FitMap(log, log.scans, 0.1);
  ASSERT_TRUE(map);
  const int row = static_cast<int>(-map->origin_y / 0.1),
            column = static_cast<int>((30 - map->origin_x) / 0.1);
  ASSERT_LT(column + 1, map->width);
  EXPECT_TRUE(map->at(column, row) == Cell::kOccupied ||
              map->at(column - 1, row) == Cell::kOccupied ||
              map->at(column + 1, row) == Cell::kOccupied);
}

TEST(Comparison, FitsTheBiasOfRangesToAnchors) {
  const auto devices = Fit(RangesOf(0.1, 0.02), {});
  ASSERT_TRUE(devices) << devices.error().Sentence();
  ASSERT_EQ(devices->size(), 1u);
  for (const FittedParameter& parameter : devices->front().parameters) {
    const double expected = parameter.name == "noise.mean"       ? 0.1
                            : parameter.name == "bias_per_metre" ? 0.02
                                                                 : 0;
    EXPECT_WITHIN(parameter.value, expected, 1e-6, parameter.unit.c_str()) << parameter.name;
    EXPECT_WITHIN(parameter.confidence, 0, 1e-6, parameter.unit.c_str()) << parameter.name;
  }
}

TEST(Comparison, SimulatesRangesAtTheRecordedPoses) {
  CompareOptions options;
  options.parameters = {{"noise.mean", 0.1}, {"max", 4.0}};
  const Log log = RangesOf(0, 0);
  const auto ranges = SimulatedRanges(log, options);
  ASSERT_TRUE(ranges) << ranges.error().Sentence();
  EXPECT_WITHIN(ranges->at(20), 2.1, 1e-9, "m");
  EXPECT_TRUE(std::isinf(ranges->at(80)));  // the distance is 5 m here
}

TEST(Comparison, WritesAFitAsOneElementForEachGroup) {
  const std::string sdf = ToSdf({{"lidar",
                                  "scan",
                                  {{"noise.mean", "m", 0.02, 0.001},
                                   {"short_range", "m", 1, 0},
                                   {"noise.stddev", "m", 0.003, 0.0001}}}});
  EXPECT_EQ(sdf,
            "<sensor name=\"scan\" type=\"lidar\">\n"
            "  <gsv:short_range>1</gsv:short_range>  <!-- ± 0 m -->\n"
            "  <gsv:noise>\n"
            "    <gsv:mean>0.02</gsv:mean>  <!-- ± 0.001 m -->\n"
            "    <gsv:stddev>0.003</gsv:stddev>  <!-- ± 0.0001 m -->\n"
            "  </gsv:noise>\n"
            "</sensor>\n");
}

TEST(WorldFit, RemovesAWallThatBeamsPassAndAddsOneWhereTheyEnd) {
  OccupancyMap map;
  map.width = map.height = 20, map.resolution = 0.1;
  map.cells.assign(400, Cell::kFree);
  for (int y = 0; y < 20; ++y) map.cells[static_cast<std::size_t>(20 * y + 10)] = Cell::kOccupied;
  Log log;
  log.beam_angles = {0};
  // The scans are taken along the row y = 0.55 m (cell 5), from x = 0.15 m to 1.75 m.
  const std::vector<RangeScan> scans(5, {0, {1.6}, TimedPose{0, 0.15, 0.55, 0}});
  const OccupancyMap updated = UpdatedMap(map, log, scans);
  EXPECT_NE(updated.at(10, 5), Cell::kOccupied);
  EXPECT_EQ(updated.at(10, 6), Cell::kOccupied);
  EXPECT_EQ(updated.at(17, 5), Cell::kOccupied);
}

}  // namespace
}  // namespace gsv::reality
