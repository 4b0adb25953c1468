#include "gsv/sensing/sample_all.h"

#include <gtest/gtest.h>

#include "gsv/sensing/registry.h"
#include "gsv/sensing/test_rays.h"
#include "gsv/sensing/test_snapshot.h"

namespace gsv::sensing {
namespace {

using geometry::Vector3;
using testing::Random;

constexpr double kReach = 5;

model::SensorDescription SensorOf(const std::string& type, double angle) {
  model::SensorDescription description;
  description.name = type + std::to_string(angle);
  description.type = type;
  description.link_from_sensor =
      geometry::PlanarPose(0.2 * std::cos(angle), 0.2 * std::sin(angle), 0.15, angle);
  if (type == "lidar") {
    description.parameters = {{"scan.horizontal.samples", 20.0}, {"noise.stddev", 0.01}};
  }
  if (type == "positioning") description.parameters = {{"noise.position.stddev", 0.1}};
  return description;
}

// Robots, boxes and a lorry that moves too, on a ground with one wall, `room` square metres for
// each robot.
std::shared_ptr<world::Snapshot> MakeCrowd(int robots, double room) {
  Random random(41);
  const double half = std::sqrt(room * robots) / 2;
  const auto place = [&](double z) {
    const double x = random.Uniform(-half, half), y = random.Uniform(-half, half);
    return geometry::PlanarPose(x, y, z, random.Uniform(-3, 3));
  };
  auto robot = testing::ModelOf(geometry::Cylinder{0.175, 0.3});
  robot->links[0].collisions[0].link_from_collision.position.z = 0.15;
  std::vector<testing::Placed> bodies;
  bodies.push_back({"ground", testing::ModelOf(geometry::Plane{}), {}, true});
  bodies.push_back({"wall", testing::ModelOf(geometry::Box{{0.1, 2 * half, 1}}),
                    geometry::PlanarPose(half, 0, 0.5, 0.1), true});
  bodies.push_back(
      {"lorry", testing::ModelOf(geometry::Box{{12, 2.5, 3}}), {{0, 0, 1.6}, {}}, false});
  for (int i = 0; i < robots / 4; ++i) {
    bodies.push_back(
        {"box" + std::to_string(i), testing::ModelOf(geometry::Box{{1, 1, 1}}), place(0.5), true});
  }
  for (int i = 0; i < robots; ++i) {
    bodies.push_back({"robot" + std::to_string(i), robot, place(0), false});
  }
  return testing::MakeSnapshot(bodies);
}

class SampleAllTest : public ::testing::Test {
 protected:
  SampleAllTest() {
    SensorRegistry registry;
    AddBuiltInSensors(registry);
    for (int i = 0; i < 8; ++i) Add(registry, "sonar", 0.785 * i);
    Add(registry, "lidar", 0.1);
    Add(registry, "positioning", 0.2);
  }

  // All sensors on all robots, that they share.
  std::vector<SensorAt> Everywhere(const world::Snapshot& snapshot) const {
    std::vector<SensorAt> all;
    for (int body = 0; body < static_cast<int>(snapshot.layout->bodies.size()); ++body) {
      if (snapshot.layout->bodies[body].is_static) continue;
      for (const auto& sensor : sensors_) all.push_back({sensor.get(), body});
    }
    return all;
  }

  std::vector<std::unique_ptr<Sensor>> sensors_;

 private:
  void Add(const SensorRegistry& registry, const std::string& type, double angle) {
    sensors_.push_back(*registry.Find(type)->create(SensorOf(type, angle)));
  }
};

TEST_F(SampleAllTest, IsTheSameAsOneByOneForAnyNumberOfThreads) {
  for (const double room : {10.0, 0.5}) {  // as in a hall; too many around to be gathered
    const auto snapshot = MakeCrowd(120, room);
    RaySceneCache rays;
    const std::vector<SensorAt> all = Everywhere(*snapshot);
    for (const int threads : {1, 2, 5}) {
      base::ThreadTeam team(threads);
      std::vector<base::Result<Reading>> readings(all.size());
      RaySceneCache own;
      SampleAll(snapshot, 7, own, all, team, readings);
      for (std::size_t i = 0; i < all.size(); ++i) {
        const auto alone = all[i].sensor->Sample(Sampling(snapshot, all[i].body, 7, rays));
        ASSERT_TRUE(readings[i]);
        ASSERT_EQ(readings[i]->values, alone->values) << threads << " " << i;
      }
    }
  }
}

TEST_F(SampleAllTest, SonarsMeasureWhatLookingAtEverythingFinds) {
  for (const double room : {10.0, 0.5}) {
    const auto snapshot = MakeCrowd(60, room);
    RaySceneCache rays;
    base::ThreadTeam team(2);
    const std::vector<SensorAt> all = Everywhere(*snapshot);
    std::vector<base::Result<Reading>> readings(all.size());
    SampleAll(snapshot, 7, rays, all, team, readings);
    int echoes = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const model::SensorDescription& sonar = all[i].sensor->description();
      if (sonar.type != "sonar") continue;
      const geometry::Pose world_from_sonar =
          world::LinkPose(*snapshot, all[i].body, sonar.link) * sonar.link_from_sensor;
      const auto hit = testing::BruteForce(
          *snapshot,
          {world_from_sonar.position, world_from_sonar.orientation * Vector3{1, 0, 0}, kReach},
          all[i].body);
      echoes += hit.has_value();
      ASSERT_NEAR(readings[i]->values[0], hit ? hit->distance : kReach, 1e-9) << i;
    }
    EXPECT_GT(echoes, 100);
  }
}

TEST_F(SampleAllTest, OfNoSensorsDoesNothing) {
  RaySceneCache rays;
  base::ThreadTeam team(2);
  SampleAll(MakeCrowd(1, 10), 7, rays, {}, team, {});
}

}  // namespace
}  // namespace gsv::sensing
