#include "gsv/reality/statistics.h"

#include <cmath>

#include <gtest/gtest.h>

#include "gsv/base/random.h"
#include "gsv/base/test_within.h"
#include "gsv/reality/odometry_comparison.h"
#include "gsv/reality/world_fit.h"

namespace gsv::reality {
namespace {

TEST(Statistics, EqualTextbookValues) {
  const std::vector<double> values = {2, 4, 4, 4, 5, 5, 7, 9};
  EXPECT_EQ(Summarize(values).mean, 5);
  EXPECT_WITHIN(Summarize(values).deviation, std::sqrt(32.0 / 7), 1e-12, "");
  EXPECT_EQ(Quantile(values, 0), 2);
  EXPECT_EQ(Quantile(values, 1), 9);
  EXPECT_EQ(Quantile({}, 0.5), 0);
  EXPECT_WITHIN(RobustDeviation({1, 2, 3, 4, 100}), 1.4826, 1e-12, "");
}

TEST(Statistics, DistinguishDistributions) {
  EXPECT_EQ(KolmogorovSmirnov({1, 2, 3}, {1, 2, 3}), 0);
  EXPECT_EQ(KolmogorovSmirnov({1, 2}, {3, 4}), 1);
  EXPECT_WITHIN(KolmogorovSmirnov({1, 2, 3, 4}, {3, 4, 5, 6}), 0.5, 1e-12, "");
  EXPECT_EQ(KolmogorovSmirnov({}, {1}), 1);
}

TEST(Statistics, ComputeCorrelations) {
  // The first-order process x' = 0.7 x + noise has the autocorrelation 0.7.
  base::Noise noise(1, 2, 3);
  std::vector<double> values = {0};
  for (int i = 0; i < 20000; ++i) values.push_back(0.7 * values.back() + noise.Gaussian());
  EXPECT_WITHIN(Autocorrelation(values, 1), 0.7, 0.02, "");
  EXPECT_EQ(Autocorrelation(std::vector<double>{1, 1, 1}, 1), 0);
}

TEST(OdometryComparison, FitsTheDriftThatMadeTheLog) {
  // A robot that drives wide arcs, alternately to the left and to the right.
  std::vector<TimedPose> truth = {{0, 0, 0, 0}};
  for (int i = 1; i < 40000; ++i) {
    TimedPose next = truth.back();
    const double turn = (i / 500) % 2 == 0 ? 0.006 : -0.004;
    next.time += 0.1;
    next.x += 0.03 * std::cos(next.yaw + turn / 2), next.y += 0.03 * std::sin(next.yaw + turn / 2);
    next.yaw += turn;
    truth.push_back(next);
  }
  sensing::OdometryDrift drift;
  drift.linear_scale = 1.05, drift.angular_scale = 0.95;
  drift.linear_per_metre = 0.04;
  drift.angular_per_radian = 0.06;
  const auto windows = Windows(SimulatedOdometry(truth, drift, 7), truth, 5);
  const sensing::OdometryDrift fit = FitDrift(windows);
  EXPECT_WITHIN_PERCENT(fit.linear_scale, 1.05, 1);
  EXPECT_WITHIN_PERCENT(fit.angular_scale, 0.95, 1);
  EXPECT_WITHIN_PERCENT(fit.linear_per_metre, 0.04, 12);
  EXPECT_WITHIN_PERCENT(std::hypot(fit.angular_per_radian, fit.angular_per_metre), 0.06, 30);
}

// The estimated distance of a window is 1.05 * 0.3 m, with errors of ±0.1 m. A regression of the
// true distances on the estimated distances has a bias: its inverse would be a scale of 1.16.
TEST(OdometryComparison, FitsTheScaleWithoutBias) {
  std::vector<MotionWindow> windows;
  for (int i = 0; i < 40; ++i) {
    MotionWindow window;
    window.true_way = window.metres = 0.3;
    window.true_turn = window.radians = 0.2;
    window.reckoned_way = 1.05 * 0.3 + (i % 2 == 0 ? 0.1 : -0.1);
    window.reckoned_turn = 0.9 * 0.2 + (i / 2 % 2 == 0 ? 0.05 : -0.05);
    windows.push_back(window);
  }
  const sensing::OdometryDrift fit = FitDrift(windows);
  EXPECT_NEAR(fit.linear_scale, 1.05, 1e-12);
  EXPECT_NEAR(fit.angular_scale, 0.9, 1e-12);
  EXPECT_NEAR(fit.linear_per_metre, 0.1 / std::sqrt(0.3), 1e-12);
}

TEST(WorldFit, FindsTheWallThatAScannerSaw) {
  Log log;
  log.max_range = 10;
  log.beam_angles = {-0.1, 0, 0.1};
  for (int i = 0; i < 10; ++i) {
    const double x = 0.05 * i;
    const double wall = 2 - x;
    RangeScan scan{0.1 * i, {}, TimedPose{0.1 * i, x, 0, 0}};
    for (const double angle : log.beam_angles) scan.ranges.push_back(wall / std::cos(angle));
    log.scans.push_back(scan);
  }
  const auto map = FitMap(log, log.scans, 0.1);
  ASSERT_TRUE(map);
  int occupied = 0;
  for (int y = 0; y < map->height; ++y) {
    for (int x = 0; x < map->width; ++x) {
      if (map->at(x, y) != Cell::kOccupied) continue;
      ++occupied;
      EXPECT_WITHIN(map->origin_x + (x + 0.5) * 0.1, 2, 0.1, "m");
    }
  }
  EXPECT_GE(occupied, 3);
  EXPECT_FALSE(FitMap(log, {}, 0.1));
}

}  // namespace
}  // namespace gsv::reality
