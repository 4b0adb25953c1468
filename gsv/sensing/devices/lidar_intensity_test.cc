// Compares the intensities of a lidar with Lambert's law in closed form.
#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include "gsv/base/test_within.h"
#include "gsv/geometry/constants.h"
#include "gsv/messages/cdr.h"
#include "gsv/messages/sensor_msgs.h"
#include "gsv/sensing/testing/test_sensor.h"
#include "gsv/sensing/testing/test_snapshot.h"

namespace gsv::sensing::intensities {
namespace {

using geometry::kInfinity;
using geometry::kPi;
using geometry::Pose;
using testing::BuiltInSensors;
using testing::DescriptionOf;
using testing::MakeSnapshot;
using testing::ModelOf;

std::shared_ptr<model::Model> Coloured(const geometry::Shape& shape, double r, double g, double b) {
  auto model = ModelOf(shape);
  model::Visual visual;
  visual.shape = shape;
  visual.materials[0].base_colour = {r, g, b, 1};
  model->links[0].visuals.push_back(visual);
  return model;
}

// Returns a mesh that is one large triangle across the x axis.
geometry::Mesh LargeTriangle() {
  auto triangles = std::make_shared<geometry::TriangleMesh>();
  triangles->positions = {{0, -9, -9}, {0, 9, -9}, {0, 0, 9}};
  triangles->triangles = {{0, 1, 2}};
  geometry::Mesh mesh;
  mesh.triangles = triangles;
  mesh.scale = {1, 1, 1};
  return mesh;
}

// Returns a lidar at the world's origin that faces x, with beams at the azimuths 0 and ±0.3.
model::SensorDescription Beams(model::Parameters more) {
  model::Parameters parameters{{"scan.horizontal.samples", 3.0},
                               {"scan.horizontal.min_angle", -0.3},
                               {"scan.horizontal.max_angle", 0.3},
                               {"range.max", 20.0}};
  for (auto& [name, value] : more) parameters[name] = value;
  auto description = DescriptionOf("lidar", std::move(parameters));
  description.link_from_sensor = {};
  return description;
}

class LidarIntensity : public ::testing::Test {
 protected:
  Reading Sample(const std::shared_ptr<const model::Model>& object, const Pose& pose,
                 const model::SensorDescription& description, bool is_static = true) {
    const auto snapshot = MakeSnapshot({{"robot", ModelOf(geometry::Sphere{0.05}), {}, false},
                                        {"surface", object, pose, is_static}});
    const auto sensor = BuiltInSensors().Find("lidar")->create(description);
    EXPECT_TRUE(sensor);
    return *(*sensor)->Sample(Sampling(snapshot, 0, 1, rays_));
  }

  RaySceneCache rays_;
};

TEST_F(LidarIntensity, FollowsTheAngleOfIncidenceAndTheColour) {
  // The wall is across the x axis, rotated by 0.5 rad. Its colour is green: red and blue are zero.
  const auto wall = Coloured(geometry::Box{{0.2, 40, 4}}, 0, 1, 0);
  for (const bool is_static : {true, false}) {
    const Reading reading = Sample(wall, geometry::PlanarPose(5, 0, 0, 0.5),
                                   Beams({{"intensity_scale", 100.0}}), is_static);
    ASSERT_EQ(reading.values.size(), 6u);
    for (std::size_t i = 0; i < 3; ++i) {
      const double azimuth = -0.3 + 0.3 * static_cast<double>(i);
      EXPECT_WITHIN(reading.values[3 + i], 100 * 0.7152 * std::cos(azimuth - 0.5), 1e-5, "") << i;
    }
  }
}

TEST_F(LidarIntensity, FallsWithTheSquareOfTheDistanceIfTheDeviceDoesNotCompensate) {
  const auto wall = Coloured(geometry::Box{{0.2, 40, 4}}, 1, 1, 1);
  for (const double distance : {1.0, 4.0, 9.0}) {
    const Reading reading = Sample(wall, geometry::PlanarPose(distance + 0.1, 0, 0, 0),
                                   Beams({{"intensity_scale", 100.0}, {"intensity_range", 2.0}}));
    // The distance at an azimuth a is distance / cos a.
    for (const auto& [beam, azimuth] : {std::pair{4, 0.0}, std::pair{5, 0.3}}) {
      const double range = distance / std::cos(azimuth);
      EXPECT_WITHIN(reading.values[static_cast<std::size_t>(beam)],
                    100 * std::cos(azimuth) * 4 / (range * range), 1e-4, "")
          << distance;
    }
  }
}

TEST_F(LidarIntensity, OfABallFollowsFromItsNormal) {
  const auto ball = Coloured(geometry::Sphere{2}, 1, 1, 1);
  const Reading reading =
      Sample(ball, geometry::PlanarPose(5, 0.5, 0, 0), Beams({{"intensity_scale", 1.0}}));
  for (std::size_t i = 0; i < 3; ++i) {
    const double azimuth = -0.3 + 0.3 * static_cast<double>(i);
    // The radius of the sphere is 2 m. The beam's line passes the centre at the distance d, so the
    // sine of the angle of incidence is d / 2.
    const double d = std::abs(0.5 * std::cos(azimuth) - 5 * std::sin(azimuth));
    EXPECT_WITHIN(reading.values[3 + i], std::sqrt(1 - d * d / 4), 1e-6, "") << i;
  }
}

TEST_F(LidarIntensity, OfATexturedMeshIsTheMeanOfItsTexture) {
  auto board = Coloured(LargeTriangle(), 1, 1, 1);
  auto chequered = std::make_shared<model::Image>();
  chequered->width = chequered->height = 16;
  for (int i = 0; i < 16 * 16; ++i) {
    const std::uint8_t level = (i / 16 + i) % 2 == 0 ? 255 : 0;
    chequered->pixels.insert(chequered->pixels.end(), 3, level);
  }
  board->links[0].visuals[0].materials[0].base_colour_map = chequered;
  const Reading reading =
      Sample(board, geometry::PlanarPose(5, 0, 0, 0), Beams({{"intensity_scale", 1.0}}));
  EXPECT_WITHIN(reading.values[4], 0.5, 1e-6, "");
}

TEST_F(LidarIntensity, IsZeroForABeamWithoutAnEcho) {
  const auto post = Coloured(geometry::Box{{0.2, 0.2, 4}}, 1, 1, 1);
  const Reading reading =
      Sample(post, geometry::PlanarPose(5, 0, 0, 0), Beams({{"intensity_scale", 100.0}}));
  EXPECT_EQ(reading.values[0], kInfinity);
  EXPECT_EQ(reading.values[3], 0);
  EXPECT_WITHIN(reading.values[4], 100, 1e-5, "");
}

TEST_F(LidarIntensity, IsNotMeasuredByDefaultAndDoesNotChangeTheRanges) {
  const auto wall = Coloured(geometry::Box{{0.2, 40, 4}}, 1, 1, 1);
  const Pose pose = geometry::PlanarPose(5, 0, 0, 0);
  const Reading without = Sample(wall, pose, Beams({{"noise.stddev", 0.1}}));
  const Reading with = Sample(wall, pose, Beams({{"noise.stddev", 0.1}, {"intensity_scale", 1.0}}));
  ASSERT_EQ(without.values.size(), 3u);
  ASSERT_EQ(with.values.size(), 6u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(with.values[i], without.values[i]);
}

TEST_F(LidarIntensity, IsInTheScanAndInThePointCloud) {
  const auto wall = Coloured(geometry::Box{{0.2, 40, 40}}, 1, 1, 1);
  const Pose pose = geometry::PlanarPose(5, 0, 0, 0);
  const auto flat = Beams({{"intensity_scale", 100.0}});
  const SensorType& type = *BuiltInSensors().Find("lidar");
  const auto bytes = (*type.create(flat))->Encode(Sample(wall, pose, flat), "robot/front");
  ASSERT_TRUE(bytes);
  const auto scan =
      messages::Decode<messages::sensor_msgs::LaserScan>(std::as_bytes(std::span(*bytes)));
  ASSERT_TRUE(scan);
  ASSERT_EQ(scan->ranges.size(), 3u);
  ASSERT_EQ(scan->intensities.size(), 3u);
  EXPECT_NEAR(scan->intensities[2], 100 * std::cos(0.3), 1e-4);
  const auto rows = Beams({{"intensity_scale", 100.0},
                           {"scan.vertical.samples", 2.0},
                           {"scan.vertical.max_angle", 0.2}});
  const auto points =
      (*type.create(rows))->EncodeCompanionOf(Sample(wall, pose, rows), "robot/front");
  const auto cloud =
      messages::Decode<messages::sensor_msgs::PointCloud2>(std::as_bytes(std::span(points)));
  ASSERT_TRUE(cloud);
  ASSERT_EQ(cloud->fields.size(), 5u);
  EXPECT_EQ(cloud->fields[4].name, "intensity");
  ASSERT_EQ(cloud->data.size(), std::size_t{6} * cloud->point_step);
  float intensity = 0;
  std::memcpy(&intensity, &cloud->data[4 * cloud->point_step + cloud->fields[4].offset],
              sizeof intensity);
  EXPECT_NEAR(intensity, 100 * std::cos(0.2), 1e-4);  // the beam in the middle of the upper row
}

}  // namespace
}  // namespace gsv::sensing::intensities
