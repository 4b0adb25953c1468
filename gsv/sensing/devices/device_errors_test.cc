// Tests the simulated errors of devices against closed forms. It covers the presets,
// lidar_errors.h, odometry_drift.h, the full model of sound_cone.h, and the Allan parameters of
// imu.h.
#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "gsv/base/test_within.h"
#include "gsv/geometry/constants.h"
#include "gsv/sensing/device.h"
#include "gsv/sensing/devices/built_in.h"
#include "gsv/sensing/devices/odometry_drift.h"
#include "gsv/sensing/presets.h"
#include "gsv/sensing/registry.h"
#include "gsv/sensing/testing/test_snapshot.h"

namespace gsv::sensing {
namespace {

using geometry::kInfinity;
using geometry::kPi;
using geometry::PlanarPose;
using ::testing::HasSubstr;

constexpr double kDegree = kPi / 180;

struct Spread {
  double mean = 0, deviation = 0;
  explicit Spread(const std::vector<double>& values) {
    const auto count = static_cast<double>(values.size());
    for (const double value : values) mean += value / count;
    for (const double value : values) deviation += (value - mean) * (value - mean) / count;
    deviation = std::sqrt(deviation);
  }
};

class DeviceErrors : public ::testing::Test {
 protected:
  DeviceErrors() { AddBuiltInSensors(registry_); }

  void Place(std::vector<testing::Placed> things) {
    things.push_back({"robot", robot_, {}, false});
    snapshot_ = testing::MakeSnapshot(things);
  }
  std::unique_ptr<Sensor> Create(const std::string& type, model::Parameters parameters,
                                 double rate = 0) {
    model::SensorDescription description;
    description.name = description.type = type;
    description.update_rate = rate;
    description.parameters = std::move(parameters);
    auto sensor = registry_.Find(type)->create(description);
    EXPECT_TRUE(sensor) << sensor.error().Sentence();
    return sensor ? *std::move(sensor) : nullptr;
  }
  std::vector<double> Read(const Sensor& sensor, std::uint64_t step = 0) {
    snapshot_->state.step = step;
    const auto reading =
        sensor.Sample(Sampling(snapshot_, snapshot_->layout->Find("robot"), 1, rays_));
    return {reading->values.begin(), reading->values.end()};
  }

  double RateAt(const Sensor& imu, double seconds, std::uint64_t seed);

  std::shared_ptr<model::Model> robot_ = testing::ModelOf(geometry::Sphere{0.01});
  SensorRegistry registry_;
  std::shared_ptr<world::Snapshot> snapshot_;
  RaySceneCache rays_;
};

testing::Placed Wall(double distance, double width, double height, double yaw = 0) {
  return {"wall", testing::ModelOf(geometry::Box{{0.01, width, height}}),
          PlanarPose(distance + 0.005, 0, 0, yaw), true};
}

TEST_F(DeviceErrors, EveryPresetIsValidAndNamesItsSource) {
  for (const Preset& preset : Presets()) {
    model::Parameters parameters = {{"preset", preset.name}};
    if (preset.type == "ranging") parameters["anchor"] = std::string("anchor");
    EXPECT_NE(Create(preset.type, parameters), nullptr) << preset.name;
    EXPECT_GT(preset.source.size(), 20u) << preset.name;
  }
}

TEST_F(DeviceErrors, SensorParametersOverrideThePreset) {
  model::SensorDescription description;
  description.type = "sonar";
  description.parameters = {{"preset", std::string("hc_sr04")}, {"max", 2.0}};
  const auto whole = WithPreset("sonar", description);
  ASSERT_TRUE(whole);
  EXPECT_EQ(model::NumberOr(whole->parameters, "max", 0), 2);
  EXPECT_EQ(model::NumberOr(whole->parameters, "frequency", 0), 40000);
}

TEST_F(DeviceErrors, UnknownPresetIsRejected) {
  model::SensorDescription description;
  description.name = description.type = "sonar";
  description.parameters = {{"preset", std::string("bat")}};
  EXPECT_EQ(registry_.Find("sonar")->create(description).error().Sentence(),
            "sonar sonar: there is no preset \"bat\"; the presets are hc_sr04, mb1010, "
            "polaroid_6500");
}

TEST_F(DeviceErrors, LidarNoiseGrowsWithRange) {
  Place({Wall(4, 20, 20)});
  const auto lidar = Create("lidar", {{"scan.horizontal.samples", 1.0},
                                      {"scan.horizontal.min_angle", 0.0},
                                      {"scan.horizontal.max_angle", 0.0},
                                      {"range_noise", 0.01}});
  std::vector<double> errors;
  for (int i = 0; i < 4000; ++i) errors.push_back(Read(*lidar, i)[0] - 4);
  const Spread seen(errors);
  EXPECT_WITHIN_3_SIGMA(seen.mean, 0, 0.04 / std::sqrt(4000.0));
  EXPECT_WITHIN_3_SIGMA(seen.deviation, 0.04, 0.04 / std::sqrt(8000.0));
}

TEST_F(DeviceErrors, LidarNoiseGrowsWithTheAngleOfIncidence) {
  for (const double angle : {0.0, 30 * kDegree, 60 * kDegree}) {
    Place({Wall(4, 20, 20, angle)});
    // The sensor computes the tangent from the ranges of adjacent beams.
    const auto lidar = Create("lidar", {{"scan.horizontal.samples", 3.0},
                                        {"scan.horizontal.min_angle", -1e-3},
                                        {"scan.horizontal.max_angle", 1e-3},
                                        {"noise.stddev", 1e-9},
                                        {"incidence_noise", 0.02}});
    std::vector<double> ranges;
    for (int i = 0; i < 4000; ++i) ranges.push_back(Read(*lidar, i)[1]);
    const double expected = 0.02 * std::tan(angle);
    EXPECT_WITHIN_3_SIGMA(Spread(ranges).deviation, expected, expected / std::sqrt(8000.0) + 1e-9);
  }
}

TEST_F(DeviceErrors, LidarMissesSlantedSurfaces) {
  Place({Wall(2, 60, 1)});
  const auto lidar = Create("lidar", {{"scan.horizontal.samples", 101.0},
                                      {"scan.horizontal.min_angle", -1.4},
                                      {"scan.horizontal.max_angle", 1.4},
                                      {"range.max", 30.0},
                                      {"reach", 6.0}});
  const std::vector<double> ranges = Read(*lidar);
  EXPECT_TRUE(std::isfinite(ranges[50]));
  EXPECT_EQ(ranges[0], kInfinity);
  // The reach ends at 61.3 degrees, where 2 / cos t = 6 sqrt(cos t). Angles from 50 to 70 degrees
  // are not tested, because some echoes are lost in the last tenth of the reach.
  for (int i = 0; i < 101; ++i) {
    const double angle = std::abs(-1.4 + 2.8 * i / 100);
    if (angle < 50 * kDegree) {
      EXPECT_TRUE(std::isfinite(ranges[i])) << i;
    } else if (angle > 70 * kDegree) {
      EXPECT_EQ(ranges[i], kInfinity) << i;
    }
  }
}

TEST_F(DeviceErrors, LidarMixesTwoSurfacesAtAnEdge) {
  Place({Wall(2, 0.5, 1),
         {"back", testing::ModelOf(geometry::Box{{0.01, 20, 1}}), PlanarPose(4, 0, 0, 0), true}});
  const auto lidar = Create("lidar", {{"scan.horizontal.samples", 61.0},
                                      {"scan.horizontal.min_angle", -0.5},
                                      {"scan.horizontal.max_angle", 0.5},
                                      {"beam_divergence", 0.01}});
  int between = 0, scans = 500;
  for (int step = 0; step < scans; ++step) {
    for (const double range : Read(*lidar, step)) {
      if (range > 2.2 && range < 3.8) ++between;
    }
  }
  // The expected number of mixed ranges. There are two edges. Each edge is between two beams, so
  // four beams are beside an edge. In each scan, the lidar compares a beam with one of its two
  // neighbours, at random. In half of the scans, this is the neighbour across the edge. The beam
  // then covers the edge with the probability divergence / step = 0.6. Of the mixed ranges, the
  // fraction 0.8 is between 2.2 and 3.8 m, where the test counts them.
  const double expected = 4 * 0.5 * 0.6 * 0.8 * scans;
  EXPECT_WITHIN_PERCENT(between, expected, 15);
}

TEST_F(DeviceErrors, ImuNoiseHasTheConfiguredDensity) {
  Place({});
  const auto imu = Create("imu", {{"angular_velocity.noise_density", 1e-3}}, 400);
  std::vector<double> rates;
  for (int i = 0; i < 4000; ++i) rates.push_back(Read(*imu, i)[2]);
  EXPECT_WITHIN_3_SIGMA(Spread(rates).deviation, 0.02, 0.02 / std::sqrt(8000.0));
}

// The rate that is read at rest at `seconds`.
double DeviceErrors::RateAt(const Sensor& imu, double seconds, std::uint64_t seed) {
  snapshot_->state.time = base::FromSeconds(seconds);
  snapshot_->state.step = static_cast<std::uint64_t>(seconds * 100);
  const auto reading =
      imu.Sample(Sampling(snapshot_, snapshot_->layout->Find("robot"), seed, rays_));
  return reading->values[2];
}

// A random walk K: in a time t, the bias changes by a normally distributed value with the variance
// K^2 t (IEEE 952, C.1.4).
TEST_F(DeviceErrors, ImuBiasWalksRandomly) {
  Place({});
  const double walk = 1e-3;
  const auto imu = Create("imu", {{"angular_velocity.random_walk", walk}}, 100);
  constexpr int kRuns = 3000;
  for (const double seconds : {20.0, 60.0}) {
    std::vector<double> changes;
    for (int seed = 0; seed < kRuns; ++seed) {
      const auto run = static_cast<std::uint64_t>(seed);
      changes.push_back(RateAt(*imu, 50 + seconds, run) - RateAt(*imu, 50, run));
    }
    const double expected = walk * std::sqrt(seconds);
    // The walk is simulated as a drift with a correlation time of an hour. This reduces the
    // variance after 20 s by 0.3 %.
    EXPECT_WITHIN(Spread(changes).deviation, expected,
                  (0.01 + 3 / std::sqrt(2.0 * kRuns)) * expected, "rad/s")
        << seconds;
  }
}

// The test uses a bias that drifts with the correlation time T and the deviation d. The Allan
// deviation of this bias has its maximum, 0.617 d, at 1.89 T (IEEE 952, C.1.5). The maximum equals
// the configured instability within 10 %.
TEST_F(DeviceErrors, ImuBiasHasTheConfiguredInstability) {
  Place({});
  const double instability = 1e-3, time = 189;
  const auto imu = Create("imu", {{"angular_velocity.bias_instability", instability}}, 100);
  constexpr int kRuns = 1000, kPoints = 20;
  double squares = 0;
  for (int seed = 0; seed < kRuns; ++seed) {
    double first = 0, second = 0;
    for (int i = 0; i < kPoints; ++i) {
      const double seconds = 100 + time * (i + 0.5) / kPoints;
      first += RateAt(*imu, seconds, static_cast<std::uint64_t>(seed)) / kPoints;
      second += RateAt(*imu, seconds + time, static_cast<std::uint64_t>(seed)) / kPoints;
    }
    squares += (second - first) * (second - first) / 2 / kRuns;
  }
  EXPECT_WITHIN_PERCENT(std::sqrt(squares), instability, 10);
}

TEST(OdometryDrift, HasTheSameVarianceForAnyLengthOfSteps) {
  OdometryDrift drift;
  drift.linear_per_metre = 0.1;
  drift.angular_per_radian = 0.2;
  for (const int steps : {1, 10}) {
    std::vector<double> ways, turns;
    for (std::uint64_t run = 0; run < 3000; ++run) {
      base::Noise noise(1, run, 0);
      OdometryStep sum;
      for (int i = 0; i < steps; ++i) {
        const double first = noise.Gaussian(), second = noise.Gaussian(), third = noise.Gaussian();
        const OdometryStep step = Drifted(drift, {4.0 / steps, 2.25 / steps}, first, second, third);
        sum.way += step.way, sum.turn += step.turn;
      }
      ways.push_back(sum.way), turns.push_back(sum.turn);
    }
    EXPECT_WITHIN_3_SIGMA(Spread(ways).mean, 4, 0.2 / std::sqrt(3000.0));
    EXPECT_WITHIN_3_SIGMA(Spread(ways).deviation, 0.2, 0.2 / std::sqrt(6000.0));
    EXPECT_WITHIN_3_SIGMA(Spread(turns).deviation, 0.3, 0.3 / std::sqrt(6000.0));
  }
}

TEST_F(DeviceErrors, OdometryErrorsAccumulateOverTheDistance) {
  Place({});
  const auto odometer = Create("odometry", {{"scale.linear", 1.1}, {"scale.angular", 0.9}});
  ASSERT_NE(odometer->device(), nullptr);
  const int body = snapshot_->layout->Find("robot");
  std::vector<world::Transmission> sent;
  world::DeviceStatePtr state;
  const auto step_now = [&](std::uint64_t number) {
    auto now = std::make_shared<world::Snapshot>(*snapshot_);
    now->state.step = number;
    return now;
  };
  // The robot drives a quarter turn about a point 1 m to the left, in 90 steps.
  for (int i = 0; i <= 90; ++i) {
    const double angle = i * kDegree;
    geometry::PlanarPosition& place = snapshot_->state.bodies[body].odometry.place;
    place = {std::sin(angle), 1 - std::cos(angle), std::cos(angle), std::sin(angle)};
    auto now = step_now(i);
    world::DeviceStep step{now, base::SimTime(0), *rays_.At(now), now->state, sent, 1};
    if (i == 0) state = odometer->device()->Apply("robot", nullptr, {}, step);
    if (auto next = state->BeforeStep(step)) state = next;
  }
  snapshot_->state.devices = std::make_shared<world::DeviceStates>(world::DeviceStates{state});
  const std::vector<double> read = Read(*odometer, 90);
  // The odometry estimates an arc of 1.1 times the length and 0.9 times the angle.
  const double turn = 81 * kDegree, radius = 1.1 / 0.9;
  EXPECT_WITHIN(read[0], radius * std::sin(turn), 0.02, "m");
  EXPECT_WITHIN(read[1], radius * (1 - std::cos(turn)), 0.02, "m");
  EXPECT_WITHIN(read[2], turn, 1e-9, "rad");
  // Velocities have the scale of the way, whatever their direction.
  world::BodyState& base = snapshot_->state.bodies[body];
  base.odometry.linear = 2, base.odometry.angular = 3, base.drive.actual.lateral = 4;
  const std::vector<double> moving = Read(*odometer, 90);
  EXPECT_WITHIN(moving[3], 1.1 * 2, 1e-12, "m/s");
  EXPECT_WITHIN(moving[4], 0.9 * 3, 1e-12, "rad/s");
  EXPECT_WITHIN(moving[5], 1.1 * 4, 1e-12, "m/s");
  EXPECT_FALSE(odometer->device()->Check({}));
  EXPECT_EQ(Create("odometry", {})->device(), nullptr);
}

TEST_F(DeviceErrors, WideTransducerDetectsAPanelBesideItsAxis) {
  const auto sonar = Create("sonar", {{"preset", std::string("hc_sr04")},
                                      {"threshold", 0.14},
                                      {"gain_range", 1.55},
                                      {"noise.stddev", 0.0},
                                      {"noise.precision", 0.0}});
  for (const double angle : {0.0, 20.0, 32.0}) {
    testing::Placed panel = Wall(0, 0.267, 1.22);
    panel.pose = PlanarPose(1.005 * std::cos(angle * kDegree), 1.005 * std::sin(angle * kDegree), 0,
                            angle * kDegree);
    Place({panel});
    EXPECT_WITHIN(Read(*sonar)[0], angle > 30 ? 4 : 1, 2e-3, "m") << angle;
  }
}

TEST_F(DeviceErrors, SmallTargetIsDetectedAtAShorterRange) {
  // A strip of 25 mm fills the fraction 25 mm / sqrt(wave length x distance / 2) of the first
  // Fresnel zone.
  const double wave_length = 343.0 / 40e3;
  const auto is_heard = [&](double distance) {
    Place({Wall(distance, 0.025, 2)});
    return Read(*Create("sonar", {{"preset", std::string("hc_sr04")},
                                  {"threshold", 0.14},
                                  {"gain_range", 1.55}}))[0] < 3.9;
  };
  // A target is detected if the fraction of the zone that it fills is at least threshold * max(1,
  // distance / gain range).
  double expected = 0.1;
  while (0.025 / std::sqrt(wave_length * expected / 2) > 0.155 * std::max(1.0, expected / 1.55)) {
    expected += 0.001;
  }
  EXPECT_TRUE(is_heard(0.9 * expected));
  EXPECT_FALSE(is_heard(1.1 * expected));
}

TEST_F(DeviceErrors, CornerIsDetectedByItsSecondReflection) {
  // Two smooth walls form a right angle whose edge is 2 m ahead. Each wall is at 45 degrees to the
  // sonar's axis.
  const auto wall = [](const char* name, double side) {
    return testing::Placed{
        name, testing::ModelOf(geometry::Box{{3, 0.02, 3}}),
        PlanarPose(2 - 1.5 * std::sqrt(0.5), side * 1.5 * std::sqrt(0.5), 0, -side * kPi / 4),
        true};
  };
  Place({wall("left", 1), wall("right", -1)});
  const model::Parameters cone = {{"beam", std::string("cone")}};
  EXPECT_EQ(Read(*Create("sonar", cone))[0], 5);
  auto full = cone;
  full["second_reflections"] = true;
  EXPECT_WITHIN(Read(*Create("sonar", full))[0], 2, 0.06, "m");
}

TEST_F(DeviceErrors, SonarsThatFireTogetherHaveCrosstalk) {
  // Two sonars are 0.5 m apart. Both point at the same point of a smooth wall, 1 m in front of the
  // middle between them. So each is turned by 25 degrees, and detects nothing if it fires alone.
  const auto turned = [](const char* name, double y) {
    model::SensorDescription sonar;
    sonar.name = name;
    sonar.type = "sonar";
    sonar.link_from_sensor = PlanarPose(0, y, 0, -std::atan2(y, 1));
    sonar.parameters = {{"beam", std::string("cone")}};
    return sonar;
  };
  model::SensorDescription left = turned("left", 0.5), right = turned("right", -0.5);
  Place({Wall(1, 10, 10)});
  EXPECT_EQ(Read(**registry_.Find("sonar")->create(left))[0], 5);
  left.parameters["firing_slot"] = right.parameters["firing_slot"] = 1.0;
  robot_->sensors = {left, right};
  Place({Wall(1, 10, 10)});
  EXPECT_WITHIN(Read(**registry_.Find("sonar")->create(left))[0], std::hypot(1, 0.5), 0.02, "m");
  robot_->sensors[1].parameters["firing_slot"] = 2.0;
  Place({Wall(1, 10, 10)});
  EXPECT_EQ(Read(**registry_.Find("sonar")->create(left))[0], 5);
}

testing::Placed AnchorAt(double x) {
  return {"anchor", testing::ModelOf(geometry::Box{{0.1, 0.1, 0.1}}), PlanarPose(x, 0, 0, 0), true};
}

TEST_F(DeviceErrors, RangingAddsABiasForEachMetreAndEachWall) {
  const model::Parameters parameters = {{"anchor", std::string("anchor")},
                                        {"noise.mean", 0.1},
                                        {"bias_per_metre", 0.02},
                                        {"wall_delay", 0.3}};
  Place({AnchorAt(5)});
  EXPECT_WITHIN(Read(*Create("ranging", parameters))[0], 5 + 0.1 + 5 * 0.02, 1e-12, "m");
  testing::Placed wall = Wall(2, 3, 3);
  Place({AnchorAt(5), wall});
  EXPECT_WITHIN(Read(*Create("ranging", parameters))[0], 5 + 0.1 + 5 * 0.02 + 0.3, 1e-12, "m");
}

TEST_F(DeviceErrors, RangingReturnsNothingForFarOrMissingPeers) {
  Place({AnchorAt(5)});
  EXPECT_TRUE(
      std::isinf(Read(*Create("ranging", {{"anchor", std::string("anchor")}, {"max", 4.0}}))[0]));
  EXPECT_TRUE(std::isinf(Read(*Create("ranging", {{"anchor", std::string("other")}}))[0]));
  Place({AnchorAt(5), Wall(2, 3, 3)});
  EXPECT_TRUE(std::isinf(
      Read(*Create("ranging", {{"anchor", std::string("anchor")}, {"max_walls", 0.0}}))[0]));
}

TEST_F(DeviceErrors, RangingNoiseGrowsWithDistance) {
  Place({AnchorAt(10)});
  const auto sensor =
      Create("ranging",
             {{"anchor", std::string("anchor")}, {"noise.stddev", 0.03}, {"range_noise", 0.004}});
  double sum = 0, squares = 0;
  constexpr int kReadings = 2000;
  for (int i = 0; i < kReadings; ++i) {
    const double off = Read(*sensor, i)[0] - 10;
    sum += off, squares += off * off;
  }
  EXPECT_WITHIN(sum / kReadings, 0, 0.005, "m");
  // the standard deviation of the sum of two errors with the standard deviations 0.03 and 0.04
  EXPECT_WITHIN(std::sqrt(squares / kReadings), 0.05, 0.003, "m");
}

}  // namespace
}  // namespace gsv::sensing
