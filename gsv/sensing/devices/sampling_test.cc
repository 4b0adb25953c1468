// Compares the readings of a crowd. Sensors may share a sampling and run on any number of threads.
// Their readings must equal the readings of sensors that are read alone, and the results of a
// brute-force search.
#include <gtest/gtest.h>

#include "gsv/base/thread_team.h"
#include "gsv/sensing/beam_set.h"
#include "gsv/sensing/devices/built_in.h"
#include "gsv/sensing/registry.h"
#include "gsv/sensing/testing/test_rays.h"
#include "gsv/sensing/testing/test_snapshot.h"

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

// A world with robots, boxes and a moving lorry, on a ground with one wall. Each robot has `room`
// square metres.
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

class SamplingTest : public ::testing::Test {
 protected:
  SamplingTest() {
    SensorRegistry registry;
    AddBuiltInSensors(registry);
    for (int i = 0; i < 8; ++i) Add(registry, "sonar", 0.785 * i);
    Add(registry, "lidar", 0.1);
    Add(registry, "positioning", 0.2);
  }

  static std::vector<int> Robots(const world::Snapshot& snapshot) {
    std::vector<int> robots;
    for (int body = 0; body < static_cast<int>(snapshot.layout->bodies.size()); ++body) {
      if (!snapshot.layout->bodies[body].is_static()) robots.push_back(body);
    }
    return robots;
  }

  // Reads robot by robot. The sensors of one robot share a sampling.
  std::vector<Reading> ReadAll(const std::shared_ptr<const world::Snapshot>& snapshot,
                               int threads) const {
    const std::vector<int> robots = Robots(*snapshot);
    std::vector<Reading> readings(robots.size() * sensors_.size());
    base::ThreadTeam team(threads);
    RaySceneCache rays;
    const auto scene = rays.At(snapshot, &team);
    team.ParallelFor(robots.size(), 16, [&](std::size_t begin, std::size_t end) {
      Sampling sampling(snapshot, -1, 7, rays);
      for (std::size_t i = begin; i < end; ++i) {
        sampling.MoveTo(robots[i]);
        sampling.ExpectRays(sensors_.size());
        for (std::size_t k = 0; k < sensors_.size(); ++k) {
          readings[i * sensors_.size() + k] = *sensors_[k]->Sample(sampling);
        }
      }
    });
    return readings;
  }

  std::vector<std::unique_ptr<Sensor>> sensors_;

 private:
  void Add(const SensorRegistry& registry, const std::string& type, double angle) {
    sensors_.push_back(*registry.Find(type)->create(SensorOf(type, angle)));
  }
};

TEST_F(SamplingTest, BeamsHaveTheValuesThatTheirSensorsRead) {
  BeamSet beams;
  std::vector<const Sensor*> with_beam;
  // Each sensor is added twice, so that there are more beams than fit into one packet.
  for (int times = 0; times < 2; ++times) {
    for (const auto& sensor : sensors_) {
      if (sensor->beam() == nullptr) continue;
      beams.Add(*sensor);
      with_beam.push_back(sensor.get());
    }
  }
  ASSERT_EQ(with_beam.size(), 16u);
  for (const double room : {10.0, 0.5}) {
    const auto snapshot = MakeCrowd(120, room);
    RaySceneCache rays;
    int echoes = 0;
    for (const int robot : Robots(*snapshot)) {
      const Sampling sampling(snapshot, robot, 7, rays);
      std::vector<double> values(beams.size());
      beams.Sample(sampling, values);
      for (std::size_t i = 0; i < values.size(); ++i) {
        ASSERT_EQ(values[i], with_beam[i]->Sample(sampling)->values.at(0)) << robot << " " << i;
        echoes += values[i] < kReach;
      }
    }
    EXPECT_GT(echoes, 300);
  }
}

TEST_F(SamplingTest, OnlySonarsWithoutNoiseAndConeHaveABeam) {
  SensorRegistry registry;
  AddBuiltInSensors(registry);
  const auto has_beam = [&](const model::SensorDescription& description) {
    return (*registry.Find("sonar")->create(description))->beam() != nullptr;
  };
  model::SensorDescription sonar = SensorOf("sonar", 0);
  EXPECT_TRUE(has_beam(sonar));
  sonar.parameters = {{"noise.stddev", 0.01}};
  EXPECT_FALSE(has_beam(sonar));
  sonar.parameters = {{"beam", "cone"}};
  EXPECT_FALSE(has_beam(sonar));
}

TEST_F(SamplingTest, EqualsSequentialSamplingForAnyNumberOfThreads) {
  // once with few bodies nearby, and once with too many for a candidate set
  for (const double room : {10.0, 0.5}) {
    const auto snapshot = MakeCrowd(120, room);
    RaySceneCache rays;
    const std::vector<int> robots = Robots(*snapshot);
    for (const int threads : {1, 2, 5}) {
      const std::vector<Reading> readings = ReadAll(snapshot, threads);
      for (std::size_t i = 0; i < readings.size(); ++i) {
        const Sampling alone(snapshot, robots[i / sensors_.size()], 7, rays);
        ASSERT_EQ(readings[i].values, sensors_[i % sensors_.size()]->Sample(alone)->values)
            << threads << " " << i;
      }
    }
  }
}

TEST_F(SamplingTest, SonarsEqualABruteForceSearch) {
  for (const double room : {10.0, 0.5}) {
    const auto snapshot = MakeCrowd(60, room);
    const std::vector<Reading> readings = ReadAll(snapshot, 2);
    const std::vector<int> robots = Robots(*snapshot);
    int echoes = 0;
    for (std::size_t i = 0; i < readings.size(); ++i) {
      const int body = robots[i / sensors_.size()];
      const model::SensorDescription& sonar = sensors_[i % sensors_.size()]->description();
      if (sonar.type != "sonar") continue;
      const geometry::Pose world_from_sonar =
          world::LinkPose(*snapshot, body, sonar.link) * sonar.link_from_sensor;
      const auto hit = testing::BruteForce(
          *snapshot,
          {world_from_sonar.position, world_from_sonar.orientation * Vector3{1, 0, 0}, kReach},
          body);
      echoes += hit.has_value();
      ASSERT_NEAR(readings[i].values[0], hit ? hit->distance : kReach, 1e-9) << i;
    }
    EXPECT_GT(echoes, 100);
  }
}

}  // namespace
}  // namespace gsv::sensing
