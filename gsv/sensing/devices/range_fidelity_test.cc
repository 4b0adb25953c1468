// Compares readings of lidar and sonar with closed forms in the world's frame. The sensors measure
// a plane, a sphere, a cylinder and a box. The shapes and the sensors have random poses.
// docs/fidelity.md lists the tolerances.
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "gsv/base/test_within.h"
#include "gsv/geometry/constants.h"
#include "gsv/sensing/devices/built_in.h"
#include "gsv/sensing/registry.h"
#include "gsv/sensing/testing/test_rays.h"
#include "gsv/sensing/testing/test_snapshot.h"

namespace gsv::sensing {
namespace {

using geometry::Pose;
using geometry::Vector3;

using geometry::kPi;

constexpr double kNothing = geometry::kInfinity;
constexpr int kAzimuths = 24, kElevations = 9;

// A half-line. `direction` is a unit vector.
struct Line {
  Vector3 origin, direction;
  Vector3 At(double distance) const { return origin + distance * direction; }
};

// Finds the smallest distance that is above 0.
class Nearest {
 public:
  void Offer(double distance) {
    if (distance > 0 && distance < nearest_) nearest_ = distance;
  }
  double distance() const { return nearest_; }

 private:
  double nearest_ = kNothing;
};

const geometry::Plane kPlane{{0.6, 0, 0.8}, {1, 1}};
const geometry::Sphere kSphere{0.8};
const geometry::Cylinder kCylinder{0.6, 1.5};
const geometry::Box kBox{{1, 2, 0.5}};

// In the equations below, the line has the origin o and the direction d. Here, p is a point of the
// plane and n is its normal, so the distance is (p - o) n / (d n).
double ToPlane(const Line& line, const Pose& pose) {
  const Vector3 normal = pose.orientation * kPlane.normal;
  Nearest nearest;
  nearest.Offer(Dot(pose.position - line.origin, normal) / Dot(line.direction, normal));
  return nearest.distance();
}

// The distance t solves |o - c + t d| = r, where c is the centre and r is the radius.
double ToSphere(const Line& line, const Pose& pose) {
  const Vector3 from_centre = line.origin - pose.position;
  const double b = Dot(line.direction, from_centre);
  const double root =
      std::sqrt(b * b - Dot(from_centre, from_centre) + kSphere.radius * kSphere.radius);
  Nearest nearest;  // without a root, the distance is NaN, and Nearest ignores NaN
  nearest.Offer(-b - root);
  nearest.Offer(-b + root);
  return nearest.distance();
}

// On the curved surface, the distance t solves |m + t e| = r. The vectors m and e are the parts of
// o - c and of d that are perpendicular to the axis. The end faces are planes.
double ToCylinder(const Line& line, const Pose& pose) {
  const double radius = kCylinder.radius, half = kCylinder.length / 2;
  const Vector3 axis = pose.orientation * Vector3{0, 0, 1};
  const Vector3 from_centre = line.origin - pose.position;
  const double height = Dot(from_centre, axis), climb = Dot(line.direction, axis);
  const Vector3 m = from_centre - height * axis, e = line.direction - climb * axis;
  const double a = Dot(e, e), b = Dot(m, e);
  const double root = std::sqrt(b * b - a * (Dot(m, m) - radius * radius));
  Nearest nearest;
  for (const double t : {(-b - root) / a, (-b + root) / a}) {
    if (std::abs(height + t * climb) <= half) nearest.Offer(t);
  }
  for (const double lid : {-half, half}) {
    const double t = (lid - height) / climb;
    if (Norm(m + t * e) <= radius) nearest.Offer(t);
  }
  return nearest.distance();
}

// Each of the six faces is a part of a plane.
double ToBox(const Line& line, const Pose& pose) {
  const Vector3 half = 0.5 * kBox.size;
  const Vector3 axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  Nearest nearest;
  for (const Vector3& axis : axes) {
    const Vector3 normal = pose.orientation * axis;
    for (const double face : {-Dot(half, axis), Dot(half, axis)}) {
      const double t =
          (face - Dot(line.origin - pose.position, normal)) / Dot(line.direction, normal);
      bool is_within = true;
      for (const Vector3& across : axes) {
        const double off = Dot(line.At(t) - pose.position, pose.orientation * across);
        if (across != axis && !(std::abs(off) <= Dot(half, across))) is_within = false;
      }
      if (is_within) nearest.Offer(t);
    }
  }
  return nearest.distance();
}

class RangeFidelity : public ::testing::Test {
 protected:
  RangeFidelity() { AddBuiltInSensors(registry_); }

  std::vector<double> Read(const model::SensorDescription& description) {
    const auto sensor = registry_.Find(description.type)->create(description);
    EXPECT_TRUE(sensor) << sensor.error().Sentence();
    const auto reading =
        (*sensor)->Sample(Sampling(snapshot_, snapshot_->layout->Find("robot"), 1, rays_));
    EXPECT_TRUE(reading) << reading.error().Sentence();
    return {reading->values.begin(), reading->values.end()};
  }

  // Tests 160 random combinations of poses of the shape, the robot and the sensor.
  template <typename Distance>
  void Compare(const geometry::Shape& shape, const Distance& distance_to) {
    testing::Random random(3);
    int hits = 0;
    for (int i = 0; i < 160; ++i) {
      const Pose world_from_thing = random.AnyPose(2.5), world_from_robot = random.AnyPose(2);
      snapshot_ = testing::MakeSnapshot(
          {{"robot", testing::ModelOf(geometry::Sphere{0.3}), world_from_robot, false},
           {"thing", testing::ModelOf(shape), world_from_thing, i % 2 == 0}});
      model::SensorDescription lidar;
      lidar.name = lidar.type = "lidar";
      lidar.link_from_sensor = random.AnyPose(0.5);
      lidar.parameters = {{"scan.horizontal.samples", double(kAzimuths)},
                          {"scan.horizontal.min_angle", -kPi},
                          {"scan.horizontal.max_angle", kPi - 2 * kPi / kAzimuths},
                          {"scan.vertical.samples", double(kElevations)},
                          {"scan.vertical.min_angle", -1.2},
                          {"scan.vertical.max_angle", 1.2},
                          {"range.min", 0.0},
                          {"range.max", 100.0}};
      model::SensorDescription sonar = lidar;
      sonar.name = sonar.type = "sonar";
      sonar.parameters = {{"max", 100.0}};
      const Pose world_from_sensor = world_from_robot * lidar.link_from_sensor;
      const auto expected_along = [&](const Vector3& direction) {
        const double distance =
            distance_to(Line{world_from_sensor.position, world_from_sensor.orientation * direction},
                        world_from_thing);
        return distance > 100 ? kNothing : distance;
      };

      const std::vector<double> ranges = Read(lidar);
      ASSERT_EQ(ranges.size(), std::size_t{kAzimuths * kElevations});
      for (int beam = 0; beam < kAzimuths * kElevations; ++beam) {
        const int column = beam % kAzimuths, row = beam / kAzimuths;
        const double elevation = -1.2 + 2.4 * row / (kElevations - 1);
        const double azimuth = -kPi + 2 * kPi * column / kAzimuths;
        const double expected =
            expected_along({std::cos(elevation) * std::cos(azimuth),
                            std::cos(elevation) * std::sin(azimuth), std::sin(elevation)});
        if (expected == kNothing) {
          ASSERT_EQ(ranges[beam], kNothing) << "pose " << i << ", beam " << beam;
          continue;
        }
        ++hits;
        ASSERT_WITHIN(ranges[beam], expected, 1e-6, "m") << "pose " << i << ", beam " << beam;
      }
      const double ahead = expected_along({1, 0, 0});
      ASSERT_WITHIN(Read(sonar)[0], std::min(ahead, 100.0), 1e-6, "m") << "pose " << i;
    }
    EXPECT_GT(hits, 1000);
  }

  SensorRegistry registry_;
  std::shared_ptr<world::Snapshot> snapshot_;
  RaySceneCache rays_;
};

TEST_F(RangeFidelity, PlaneIsMeasuredExactly) { Compare(kPlane, ToPlane); }
TEST_F(RangeFidelity, SphereIsMeasuredExactly) { Compare(kSphere, ToSphere); }
TEST_F(RangeFidelity, CylinderIsMeasuredExactly) { Compare(kCylinder, ToCylinder); }
TEST_F(RangeFidelity, BoxIsMeasuredExactly) { Compare(kBox, ToBox); }

}  // namespace
}  // namespace gsv::sensing
