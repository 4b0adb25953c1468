#include "gsv/sensing/shared_readings.h"

#include <atomic>
#include <thread>

#include <gtest/gtest.h>

#include "gsv/sensing/testing/test_snapshot.h"

namespace gsv::sensing {
namespace {

constexpr std::size_t kImageBytes = 1000;

model::SensorDescription Named(const std::string& name) {
  model::SensorDescription description;
  description.name = name;
  description.type = "counting";
  return description;
}

// A sensor that makes a new image each time it is sampled.
class CountingSensor final : public Sensor {
 public:
  CountingSensor(const std::string& name, std::atomic<int>& taken)
      : Sensor(Named(name)), taken_(taken) {}
  base::Result<Reading> Sample(const Sampling& sampling) const override {
    Reading reading = sampling.Stamped();
    const int number = ++taken_;
    if (fails) return base::Fail(base::ErrorCode::kUnavailable, "no picture today");
    reading.values.push_back(number);
    auto image = std::make_shared<model::Image>();
    image->pixels.resize(kImageBytes);
    reading.image = std::move(image);
    return reading;
  }
  bool TakesLong() const override { return true; }

  bool fails = false;

 private:
  std::atomic<int>& taken_;
};

class SharedReadingsTest : public ::testing::Test {
 protected:
  static std::shared_ptr<world::Snapshot> TwoRobots() {
    const auto ball = testing::ModelOf(geometry::Sphere{0.1});
    return testing::MakeSnapshot(
        {{"a", ball, geometry::Pose(), false}, {"b", ball, {{1, 0, 0}, {}}, false}});
  }
  std::unique_ptr<Sensor> Make(const std::string& name, bool fails = false) {
    SensorType type;
    type.create = [&](const model::SensorDescription&) -> base::Result<std::unique_ptr<Sensor>> {
      auto sensor = std::make_unique<CountingSensor>(name, taken_);
      sensor->fails = fails;
      return sensor;
    };
    Share(type, readings_);
    return *type.create({});
  }
  // Returns the number of the sample.
  double Number(const Sensor& sensor, const std::shared_ptr<world::Snapshot>& snapshot,
                int body = 0, std::uint64_t seed = 1) {
    const auto reading = sensor.Sample(Sampling(snapshot, body, seed, rays_));
    return reading ? reading->values.at(0) : -1;
  }

  std::atomic<int> taken_ = 0;
  RaySceneCache rays_;
  std::shared_ptr<SharedReadings> readings_ =
      std::make_shared<SharedReadings>(3 * (kImageBytes + sizeof(Reading) + sizeof(double)));
};

TEST_F(SharedReadingsTest, EqualRequestsShareOneReading) {
  const auto snapshot = TwoRobots();
  const auto its = Make("camera"), recorders = Make("camera");
  EXPECT_EQ(Number(*its, snapshot), 1);
  EXPECT_EQ(Number(*recorders, snapshot), 1);
  EXPECT_EQ(taken_, 1);
}

TEST_F(SharedReadingsTest, DifferentRobotSensorSeedOrInstantIsADifferentReading) {
  const auto snapshot = TwoRobots(), later = TwoRobots();
  const auto camera = Make("camera"), other = Make("other");
  EXPECT_EQ(Number(*camera, snapshot), 1);
  EXPECT_EQ(Number(*camera, snapshot, 1), 2);
  EXPECT_EQ(Number(*other, snapshot), 3);
  EXPECT_EQ(Number(*camera, snapshot, 0, 2), 4);
  EXPECT_EQ(Number(*camera, later), 5);
}

TEST_F(SharedReadingsTest, KeepsTheNewestReadingsWithinItsSize) {
  const auto snapshot = TwoRobots();
  for (int i = 1; i <= 4; ++i) {
    EXPECT_EQ(Number(*Make("camera " + std::to_string(i)), snapshot), i);
  }
  EXPECT_EQ(readings_->bytes(), 3 * (kImageBytes + sizeof(Reading) + sizeof(double)));
  EXPECT_EQ(Number(*Make("camera 4"), snapshot), 4);
  EXPECT_EQ(Number(*Make("camera 1"), snapshot), 5);
}

TEST_F(SharedReadingsTest, RemovesReadingsOfDestroyedSnapshots) {
  auto snapshot = TwoRobots();
  const auto camera = Make("camera");
  Number(*camera, snapshot);
  snapshot = TwoRobots();
  Number(*camera, snapshot);
  EXPECT_EQ(readings_->bytes(), kImageBytes + sizeof(Reading) + sizeof(double));
}

TEST_F(SharedReadingsTest, FailuresAreNotCached) {
  const auto snapshot = TwoRobots();
  EXPECT_EQ(Number(*Make("camera", true), snapshot), -1);
  EXPECT_EQ(Number(*Make("camera"), snapshot), 2);
}

TEST_F(SharedReadingsTest, ConcurrentRequestsWaitForTheReading) {
  const auto snapshot = TwoRobots();
  const auto camera = Make("camera");
  constexpr int kAskers = 8;
  std::vector<std::thread> askers;
  askers.reserve(kAskers);
  std::atomic<int> right = 0;
  for (int i = 0; i < kAskers; ++i) {
    askers.emplace_back([&] { right += Number(*camera, snapshot) == 1; });
  }
  for (std::thread& asker : askers) asker.join();
  EXPECT_EQ(right, 8);
  EXPECT_EQ(taken_, 1);
}

}  // namespace
}  // namespace gsv::sensing
