#include "gsv/sensing/devices/geodesy.h"

#include <gtest/gtest.h>
#include <ignition/math/SphericalCoordinates.hh>

#include "gsv/base/test_within.h"
#include "gsv/geometry/constants.h"
#include "gsv/sensing/testing/test_rays.h"

namespace gsv::sensing {
namespace {

using geometry::Vector3;

using geometry::kPi;

TEST(Geodesy, ConvertsKnownPlaces) {
  EXPECT_WITHIN(EcefOf({0, 0, 0}).x, 6378137.0, 1e-9, "m");
  EXPECT_WITHIN(EcefOf({kPi / 2, 0, 0}).z, 6356752.314245, 1e-6, "m");  // TR8350.2, table 3.3
  EXPECT_WITHIN(EcefOf({0, kPi / 2, 100}).y, 6378237.0, 1e-9, "m");
}

TEST(Geodesy, RoundTripReturnsTheSamePlace) {
  testing::Random random(5);
  for (int i = 0; i < 1000; ++i) {
    const GeodeticPlace place{random.Uniform(-kPi / 2, kPi / 2), random.Uniform(-kPi, kPi),
                              random.Uniform(-1e4, 1e6)};
    const GeodeticPlace back = PlaceOf(EcefOf(place));
    EXPECT_WITHIN(back.latitude, place.latitude, 1e-14, "rad");
    EXPECT_WITHIN(back.longitude, place.longitude, 1e-14, "rad");
    EXPECT_WITHIN(back.altitude, place.altitude, 1e-8, "m");
  }
}

// M and N are the ellipsoid's radii of curvature along the meridian and across it. A small distance
// d to the north changes the latitude by d / M. The same distance to the east changes the longitude
// by d / (N cos latitude).
TEST(Geodesy, SmallDistancesAreArcsOfTheRadiiOfCurvature) {
  const double a = 6378137.0, f = 1 / 298.257223563, e2 = f * (2 - f);
  model::GeodeticOrigin origin{0.8, 0.2, 0, 0};
  const double s = std::sin(origin.latitude), w = 1 - e2 * s * s;
  const double along = a * (1 - e2) / (w * std::sqrt(w)), across = a / std::sqrt(w);
  const double way = 10;
  EXPECT_WITHIN((PlaceOf(origin, {0, way, 0}).latitude - origin.latitude) * along, way, 1e-4, "m");
  EXPECT_WITHIN((PlaceOf(origin, {way, 0, 0}).longitude - origin.longitude) * across *
                    std::cos(origin.latitude),
                way, 1e-4, "m");
  EXPECT_NEAR(PlaceOf(origin, {0, 0, way}).altitude, way, 1e-8);
}

TEST(Geodesy, AgreesWithGzMath) {
  using ignition::math::SphericalCoordinates;
  testing::Random random(6);
  for (int i = 0; i < 200; ++i) {
    const model::GeodeticOrigin origin{random.Uniform(-1.5, 1.5), random.Uniform(-kPi, kPi),
                                       random.Uniform(-100, 4000), random.Uniform(-kPi, kPi)};
    const SphericalCoordinates theirs(SphericalCoordinates::EARTH_WGS84,
                                      ignition::math::Angle(origin.latitude),
                                      ignition::math::Angle(origin.longitude), origin.elevation,
                                      ignition::math::Angle(origin.heading));
    const Vector3 point = random.Point(5000);
    const auto expected = theirs.PositionTransform(
        {point.x, point.y, point.z}, SphericalCoordinates::LOCAL2, SphericalCoordinates::SPHERICAL);
    const GeodeticPlace place = PlaceOf(origin, point);
    EXPECT_WITHIN(place.latitude, expected.X(), 1e-12, "rad");
    EXPECT_WITHIN(std::remainder(place.longitude - expected.Y(), 2 * kPi), 0, 1e-11, "rad");
    EXPECT_WITHIN(place.altitude, expected.Z(), 1e-3, "m");
  }
}

}  // namespace
}  // namespace gsv::sensing
