#include "gsv/sensing/devices/sound_cone.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "gsv/base/test_table.h"
#include "gsv/base/test_within.h"
#include "gsv/sensing/devices/built_in.h"
#include "gsv/sensing/registry.h"
#include "gsv/sensing/testing/test_snapshot.h"

namespace gsv::sensing {
namespace {

using geometry::PlanarPose;

constexpr double kDegrees = std::numbers::pi / 180;
constexpr double kMax = 6;

// Returns the reading of a cone at the origin that points along x.
double Heard(const std::vector<testing::Placed>& things, model::Parameters parameters = {}) {
  std::vector<testing::Placed> placed = things;
  placed.push_back({"robot", testing::ModelOf(geometry::Sphere{0.05}), {}, false});
  SensorRegistry registry;
  AddBuiltInSensors(registry);
  model::SensorDescription description;
  description.name = description.type = "sonar";
  description.parameters = std::move(parameters);
  description.parameters.emplace("beam", std::string("cone"));
  description.parameters.emplace("max", kMax);
  const auto snapshot = testing::MakeSnapshot(placed);
  const auto sonar = registry.Find("sonar")->create(description);
  EXPECT_TRUE(sonar) << sonar.error().Sentence();
  RaySceneCache rays;
  return (*sonar)->Sample(Sampling(snapshot, snapshot->layout->Find("robot"), 1, rays))->values[0];
}

// A smooth wall at a perpendicular distance of 2 m, in the direction `angle` from straight ahead.
std::vector<testing::Placed> WallAt(double angle) {
  const double middle = 2 + 0.05;
  return {{"wall", testing::ModelOf(geometry::Box{{0.1, 20, 20}}),
           PlanarPose(middle * std::cos(angle), middle * std::sin(angle), 0, angle), true}};
}

TEST(SoundCone, EqualsThePublishedBeamOfAPolaroidTransducer) {
  const SoundSettings polaroid;
  EXPECT_EQ(Directivity(polaroid, 0), 1);
  // The beam is 15 degrees wide at -6 dB, according to SensComp's data sheet of the 600 series.
  EXPECT_WITHIN(20 * std::log10(Directivity(polaroid, 7.5 * kDegrees)), -6, 0.3, "dB");
  // The first null of a piston is at sin t = 0.61 wave length / radius (Kuc and Siegel, 1987).
  double null = 0;
  while (Directivity(polaroid, null) > 0) null += 1e-5;
  EXPECT_WITHIN(null / kDegrees, std::asin(0.61 * 343 / 49.4e3 / 0.019) / kDegrees, 0.1, "°");
  // The first side lobe of a piston is at -17.6 dB.
  double side_lobe = 0;
  for (double t = null; t < 0.5; t += 1e-3) {
    side_lobe = std::max(side_lobe, std::abs(Directivity(polaroid, t)));
  }
  EXPECT_WITHIN(20 * std::log10(side_lobe), -17.6, 0.1, "dB");
  base::testing::Table table("beam");
  for (double t = 0; t < 30; t += 0.1) {
    table.Row({t, 20 * std::log10(std::abs(Directivity(polaroid, t * kDegrees)))});
  }
}

TEST(SoundCone, MeasuresThePerpendicularDistanceOfASmoothWall) {
  for (const double angle : {0.0, 3.0, 6.0, 9.0}) {
    EXPECT_WITHIN(Heard(WallAt(angle * kDegrees)), 2, 2 * 1e-3, "m") << angle;
    EXPECT_WITHIN(Heard(WallAt(-angle * kDegrees)), 2, 2 * 1e-3, "m") << -angle;
  }
}

TEST(SoundCone, DetectsNoSmoothWallBeyondTheCriticalAngle) {
  for (const double angle : {14.0, 20.0, 45.0}) {
    EXPECT_EQ(Heard(WallAt(angle * kDegrees)), kMax) << angle;
  }
}

TEST(SoundCone, DetectsARoughWallWhereTheBeamFirstMeetsIt) {
  // At 45 degrees, the near edge of the beam hits the wall first. This edge is some 11 degrees off
  // the axis, so the distance is 2 / cos(45° - 11°).
  const double heard = Heard(WallAt(45 * kDegrees), {{"roughness", 0.7}});
  EXPECT_GT(heard, 2 / std::cos(33 * kDegrees));
  EXPECT_LT(heard, 2 / std::cos(38 * kDegrees));
}

TEST(SoundCone, DetectsAPostBesideItsAxisThatARayMisses) {
  // The post's nearest point is on the line to its centre, 5 degrees off the axis.
  const std::vector<testing::Placed> post = {
      {"post", testing::ModelOf(geometry::Cylinder{0.05, 2}),
       PlanarPose(2 * std::cos(5 * kDegrees), 2 * std::sin(5 * kDegrees), 0, 0), true}};
  EXPECT_WITHIN(Heard(post), 1.95, 5e-3, "m");
  EXPECT_EQ(Heard(post, {{"beam", std::string("ray")}}), kMax);
}

TEST(SoundCone, DetectsNothingThatIsTooNear) { EXPECT_EQ(Heard(WallAt(0), {{"min", 2.5}}), kMax); }

TEST(SoundCone, RejectsAnUnknownBeam) {
  SensorRegistry registry;
  AddBuiltInSensors(registry);
  model::SensorDescription description;
  description.name = description.type = "sonar";
  description.parameters = {{"beam", std::string("laser")}};
  const auto sonar = registry.Find("sonar")->create(description);
  ASSERT_FALSE(sonar);
  EXPECT_EQ(sonar.error().Sentence(), "sonar sonar: beam is \"laser\"; it must be ray or cone");
}

}  // namespace
}  // namespace gsv::sensing
