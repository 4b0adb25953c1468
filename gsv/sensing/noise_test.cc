#include "gsv/sensing/noise.h"

#include <cmath>
#include <functional>
#include <numbers>

#include <gtest/gtest.h>

#include "gsv/base/test_within.h"
#include "gsv/sensing/devices/built_in.h"
#include "gsv/sensing/drift.h"
#include "gsv/sensing/registry.h"
#include "gsv/sensing/testing/test_snapshot.h"

namespace gsv::sensing {
namespace {

using base::FromSeconds;

constexpr int kMany = 4000;
constexpr std::uint64_t kSeed = 11;

struct Moments {
  double mean = 0, variance = 0;
};

Moments MomentsOf(int count, const std::function<double(int)>& value) {
  double sum = 0, squares = 0;
  for (int i = 0; i < count; ++i) {
    const double v = value(i);
    sum += v, squares += v * v;
  }
  const double mean = sum / count;
  return {mean, squares / count - mean * mean};
}

// The standard deviations of the mean and the variance of `count` normal values with variance 1.
double MeanSigma(int count) { return 1 / std::sqrt(double(count)); }
double VarianceSigma(int count) { return std::sqrt(2.0 / count); }

TEST(Drift, HasVarianceOneAtEveryInstant) {
  for (const double seconds : {0.0, 0.1, 3.3, 100.0, 639.99, 5000.0}) {
    const Moments moments = MomentsOf(
        kMany, [&](int i) { return DriftAt(FromSeconds(seconds), 10, kSeed, std::uint64_t(i)); });
    EXPECT_WITHIN_3_SIGMA(moments.mean, 0, MeanSigma(kMany)) << seconds;
    EXPECT_WITHIN_3_SIGMA(moments.variance, 1, VarianceSigma(kMany)) << seconds;
  }
}

TEST(Drift, CorrelationFallsWithTheCorrelationTime) {
  // If the times of two values differ by t, their correlation is exp(-t / correlation time). This
  // must also be true if the two values are in different blocks (border at 640 s) or in different
  // halves of a block (border at 320 s).
  for (const double lag : {0.5, 5.0, 10.0, 20.0}) {
    for (const double middle : {55.0, 320.0, 640.0}) {
      double sum = 0;
      for (int i = 0; i < kMany; ++i) {
        sum += DriftAt(FromSeconds(middle - lag / 2), 10, kSeed, std::uint64_t(i)) *
               DriftAt(FromSeconds(middle + lag / 2), 10, kSeed, std::uint64_t(i));
      }
      const double rho = std::exp(-lag / 10);
      const double sigma = std::sqrt((1 + rho * rho) / kMany);
      EXPECT_WITHIN_3_SIGMA(sum / kMany, rho, sigma) << lag << " s about " << middle;
    }
  }
}

TEST(Drift, ChangesLittleInAShortTime) {
  for (double t = 0; t < 1500; t += 0.37) {
    const double step =
        DriftAt(FromSeconds(t + 1e-3), 10, kSeed, 1) - DriftAt(FromSeconds(t), 10, kSeed, 1);
    // The bound is five times the deviation sqrt(2 dt / correlation time) = 0.014, plus the effect
    // of interpolation.
    EXPECT_LT(std::abs(step), 0.12) << t;
  }
}

// A robot with an altimeter. Without noise, the altimeter reads a height of 5 m above a reference
// of 0 m.
class NoiseTest : public ::testing::Test {
 protected:
  NoiseTest() {
    snapshot_ = testing::MakeSnapshot(
        {{"robot", testing::ModelOf(geometry::Sphere{0.2}), {{0, 0, 5}, {}}, false}});
    AddBuiltInSensors(registry_);
  }

  double Read(const std::string& name, const model::Parameters& noise, std::int64_t step,
              std::uint64_t seed = kSeed) {
    model::SensorDescription description;
    description.name = name;
    description.type = "altimeter";
    description.parameters = {{"vertical_reference", 0.0}};
    for (const auto& [key, value] : noise) {
      description.parameters["vertical_position.noise." + key] = value;
    }
    snapshot_->state.step = step;
    snapshot_->state.time = FromSeconds(0.01 * static_cast<double>(step));
    const auto sensor = registry_.Find("altimeter")->create(description);
    EXPECT_TRUE(sensor) << sensor.error().Sentence();
    return (*sensor)->Sample(Sampling(snapshot_, 0, seed, rays_))->values[0];
  }

  std::shared_ptr<world::Snapshot> snapshot_;
  SensorRegistry registry_;
  RaySceneCache rays_;
};

TEST_F(NoiseTest, WhiteNoiseHasTheGivenMeanAndDeviation) {
  const Moments moments = MomentsOf(kMany, [&](int i) {
    return Read("a", {{"mean", 0.3}, {"stddev", 0.5}}, i);
  });
  EXPECT_WITHIN_3_SIGMA(moments.mean, 5.3, 0.5 * MeanSigma(kMany));
  EXPECT_WITHIN_3_SIGMA(moments.variance, 0.25, 0.25 * VarianceSigma(kMany));
}

TEST_F(NoiseTest, BiasIsConstantAndDiffersBetweenSensors) {
  const model::Parameters noise = {{"bias_mean", 1.0}, {"bias_stddev", 0.5}};
  EXPECT_EQ(Read("a", noise, 0), Read("a", noise, 1234));
  EXPECT_NE(Read("a", noise, 0), Read("a", noise, 0, kSeed + 1));
  const Moments moments =
      MomentsOf(kMany, [&](int i) { return Read(std::to_string(i), noise, 7); });
  EXPECT_WITHIN_3_SIGMA(moments.mean, 6, 0.5 * MeanSigma(kMany));
  EXPECT_WITHIN_3_SIGMA(moments.variance, 0.25, 0.25 * VarianceSigma(kMany));
}

TEST_F(NoiseTest, DriftTendsToGazebosDeviation) {
  const model::Parameters noise = {{"dynamic_bias_stddev", 0.2},
                                   {"dynamic_bias_correlation_time", 8.0}};
  const Moments moments =
      MomentsOf(kMany, [&](int i) { return Read(std::to_string(i), noise, 300); });
  EXPECT_WITHIN_3_SIGMA(moments.variance, 0.2 * 0.2 * 8 / 2, 0.16 * VarianceSigma(kMany));
  EXPECT_NEAR(Read("a", noise, 300), Read("a", noise, 301), 0.1);
}

TEST_F(NoiseTest, ReadingsAreMultiplesOfThePrecision) {
  for (int i = 0; i < 100; ++i) {
    const double value = Read("a", {{"stddev", 1.0}, {"precision", 0.25}}, i);
    EXPECT_EQ(value * 4, std::round(value * 4));
  }
}

// If the deviation d is well below the precision s, most readings do not change. Averaged over all
// true values, two readings are then equal with the probability 1 - 2 d / (sqrt(pi) s).
TEST_F(NoiseTest, ReadingsStayIfTheDeviationIsBelowThePrecision) {
  const double deviation = 0.0012, step = 0.01;
  const int values = 400, pairs = 10;
  int equal = 0;
  for (int i = 0; i < values; ++i) {
    const double offset = step * (i + 0.5) / values;
    const model::Parameters noise = {
        {"bias_mean", offset}, {"stddev", deviation}, {"precision", step}};
    for (int k = 0; k < pairs; ++k) {
      equal += Read("a", noise, 2 * (pairs * i + k)) == Read("a", noise, 2 * (pairs * i + k) + 1);
    }
  }
  const double p = 1 - 2 * deviation / (std::sqrt(std::numbers::pi) * step);
  const int count = values * pairs;
  EXPECT_WITHIN_3_SIGMA(double(equal) / count, p, std::sqrt(p * (1 - p) / count));
}

TEST_F(NoiseTest, ReadingsDropOutWithTheGivenProbability) {
  const double p = 0.1;
  int dropped = 0;
  for (int i = 0; i < kMany; ++i) dropped += std::isnan(Read("a", {{"dropout_probability", p}}, i));
  EXPECT_WITHIN_3_SIGMA(double(dropped) / kMany, p, std::sqrt(p * (1 - p) / kMany));
}

TEST_F(NoiseTest, OutliersHaveTheGivenProbabilityAndSize) {
  const double p = 0.2;
  const model::Parameters noise = {{"outlier_probability", p}, {"outlier_stddev", 3.0}};
  int struck = 0;
  double squares = 0;
  for (int i = 0; i < kMany; ++i) {
    const double error = Read("a", noise, i) - 5;
    struck += error != 0;
    squares += error * error;
  }
  EXPECT_WITHIN_3_SIGMA(double(struck) / kMany, p, std::sqrt(p * (1 - p) / kMany));
  EXPECT_WITHIN_3_SIGMA(squares / struck, 9, 9 * VarianceSigma(struck));
}

TEST_F(NoiseTest, IsExactWithoutNoiseParameters) {
  EXPECT_EQ(Read("a", {{"type", std::string("none")}, {"stddev", 1.0}}, 3), 5);
}

}  // namespace
}  // namespace gsv::sensing
