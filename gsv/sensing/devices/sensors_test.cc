#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include "gsv/geometry/constants.h"
#include "gsv/messages/cdr.h"
#include "gsv/messages/geometry_msgs.h"
#include "gsv/messages/gsv_msgs.h"
#include "gsv/messages/sensor_msgs.h"
#include "gsv/sensing/devices/built_in.h"
#include "gsv/sensing/registry.h"
#include "gsv/sensing/testing/test_sensor.h"
#include "gsv/sensing/testing/test_snapshot.h"

namespace gsv::sensing {
namespace {

using testing::BuiltInSensors;
using testing::DescriptionOf;
using testing::MakeSnapshot;
using testing::ModelOf;

using geometry::kInfinity;
using geometry::kPi;

base::Result<std::unique_ptr<Sensor>> Make(const model::SensorDescription& description) {
  return BuiltInSensors().Find(description.type)->create(description);
}

// A robot of radius 0.25 is at (1, 0) and faces y. The near face of a wall is at y = 4.
class SensorTest : public ::testing::Test {
 protected:
  SensorTest() {
    snapshot_ = MakeSnapshot({
        {"robot", ModelOf(geometry::Cylinder{0.25, 1}), geometry::PlanarPose(1, 0, 0, kPi / 2),
         false},
        {"wall", ModelOf(geometry::Box{{20, 1, 4}}), {{0, 4.5, 0}, {}}, true},
    });
    snapshot_->state.step = 17;
    snapshot_->state.time = base::FromSeconds(1.7);
  }

  Reading Sample(const model::SensorDescription& description, std::uint64_t seed = 1) {
    const auto sensor = Make(description);
    EXPECT_TRUE(sensor);
    return *(*sensor)->Sample(Sampling(snapshot_, 0, seed, rays_));
  }

  std::shared_ptr<world::Snapshot> snapshot_;
  RaySceneCache rays_;
};

template <typename Message>
Message Decoded(const model::SensorDescription& description, const Reading& reading) {
  const auto bytes = (*Make(description))->Encode(reading, "robot/front");
  EXPECT_TRUE(bytes) << bytes.error().Sentence();
  const auto message = messages::Decode<Message>(std::as_bytes(std::span(*bytes)));
  EXPECT_TRUE(message);
  return *message;
}

TEST_F(SensorTest, SonarIgnoresItsOwnRobot) {
  const Reading reading = Sample(DescriptionOf("sonar", {{"max", 10.0}}));
  ASSERT_EQ(reading.values.size(), 1u);
  EXPECT_NEAR(reading.values[0], 3.8, 1e-12);
  EXPECT_EQ(reading.step, 17);
  EXPECT_EQ(reading.time, base::FromSeconds(1.7));
}

TEST_F(SensorTest, SonarReportsMaximumRangeWithoutAnEcho) {
  EXPECT_EQ(Sample(DescriptionOf("sonar", {{"max", 3.0}})).values[0], 3.0);
}

TEST_F(SensorTest, SonarReportsMaximumRangeWhenTheEchoIsTooNear) {
  EXPECT_EQ(Sample(DescriptionOf("sonar", {{"min", 3.9}, {"max", 10.0}})).values[0], 10.0);
}

TEST_F(SensorTest, SonarIsDrawnAsALineOfTheMeasuredLength) {
  const auto description = DescriptionOf("sonar", {{"max", 10.0}});
  const SensorType& type = *BuiltInSensors().Find("sonar");
  EXPECT_EQ(type.overlay, Overlay::kLines);
  const auto beams = (*Make(description))->Beams(Sample(description));
  ASSERT_EQ(beams.size(), 1u);
  EXPECT_NEAR(beams[0].to.x, 3.8, 1e-12);
  EXPECT_EQ(beams[0].from, geometry::Vector3{});
}

TEST_F(SensorTest, SonarReadingBecomesARangeMessage) {
  const auto description = DescriptionOf("sonar", {{"min", 0.1}, {"max", 10.0}, {"radius", 10.0}});
  const auto message = Decoded<messages::sensor_msgs::Range>(description, Sample(description));
  EXPECT_EQ(message.header.frame_id, "robot/front");
  EXPECT_EQ(message.header.stamp.sec, 1);
  EXPECT_EQ(message.header.stamp.nanosec, 700000000u);
  EXPECT_EQ(message.radiation_type, messages::sensor_msgs::Range::kUltrasound);
  EXPECT_FLOAT_EQ(message.range, 3.8f);
  EXPECT_FLOAT_EQ(message.min_range, 0.1f);
  EXPECT_FLOAT_EQ(message.max_range, 10.0f);
  EXPECT_FLOAT_EQ(message.field_of_view, static_cast<float>(kPi / 2));
}

model::Parameters Scan(double samples, double min_angle, double max_angle) {
  return {{"scan.horizontal.samples", samples},
          {"scan.horizontal.min_angle", min_angle},
          {"scan.horizontal.max_angle", max_angle},
          {"range.max", 5.0},
          {"range.min", 0.1}};
}

TEST_F(SensorTest, LidarMeasuresAlongItsAngles) {
  const Reading reading = Sample(DescriptionOf("lidar", Scan(5, -kPi / 2, kPi / 2)));
  ASSERT_EQ(reading.values.size(), 5u);
  // The wall is across the robot's path, 3.8 m ahead. At 45°, its distance of 3.8 m / cos(45°) is
  // more than the maximum of 5 m.
  EXPECT_EQ(reading.values[0], kInfinity);
  EXPECT_EQ(reading.values[1], kInfinity);
  EXPECT_NEAR(reading.values[2], 3.8, 1e-12);
  auto further = Scan(3, -kPi / 4, kPi / 4);
  further["range.max"] = 8.0;
  EXPECT_NEAR(Sample(DescriptionOf("gpu_lidar", further)).values[0], 3.8 * std::sqrt(2.0), 1e-9);
}

TEST_F(SensorTest, LidarDistinguishesTooNearFromTooFar) {
  auto parameters = Scan(1, 0, 0);
  parameters["range.min"] = 4.0;
  EXPECT_EQ(Sample(DescriptionOf("ray", parameters)).values[0], -kInfinity);
  parameters["range.min"] = 0.1;
  parameters["range.max"] = 3.0;
  EXPECT_EQ(Sample(DescriptionOf("ray", parameters)).values[0], kInfinity);
}

TEST_F(SensorTest, LidarStartsWithTheLowestRow) {
  auto parameters = Scan(1, 0, 0);
  parameters["scan.vertical.samples"] = 3.0;
  parameters["scan.vertical.min_angle"] = -0.2;
  parameters["scan.vertical.max_angle"] = 0.1;
  const Reading reading = Sample(DescriptionOf("lidar", parameters));
  ASSERT_EQ(reading.values.size(), 3u);
  EXPECT_NEAR(reading.values[0], 3.8 / std::cos(0.2), 1e-9);
  EXPECT_NEAR(reading.values[1], 3.8 / std::cos(0.05), 1e-9);
}

TEST_F(SensorTest, SingleRowLidarBecomesALaserScanMessage) {
  const auto description = DescriptionOf("lidar", Scan(5, -kPi / 2, kPi / 2));
  const SensorMessages sent = BuiltInSensors().Find("lidar")->MessagesOf(description);
  EXPECT_EQ(sent.schema->name, "sensor_msgs/msg/LaserScan");
  EXPECT_FALSE(sent.companion);
  const auto scan = Decoded<messages::sensor_msgs::LaserScan>(description, Sample(description));
  ASSERT_EQ(scan.ranges.size(), 5u);
  EXPECT_FLOAT_EQ(scan.ranges[2], 3.8f);
}

// Three rows of two beams, with the middle row level. The first beam of a row hits the wall 3.8 m
// ahead. The second beam points 45° to the side, where the wall is beyond 5 m.
model::Parameters ThreeRows() {
  auto parameters = Scan(2, 0, kPi / 4);
  parameters["scan.vertical.samples"] = 3.0;
  parameters["scan.vertical.min_angle"] = -0.1;
  parameters["scan.vertical.max_angle"] = 0.1;
  return parameters;
}

TEST_F(SensorTest, MultiRowLidarSendsAllRows) {
  const auto description = DescriptionOf("gpu_lidar", ThreeRows());
  const SensorMessages sent = BuiltInSensors().Find("lidar")->MessagesOf(description);
  EXPECT_EQ(sent.schema->name, "gsv_msgs/msg/LidarScan");
  const auto scan = Decoded<messages::gsv_msgs::LidarScan>(description, Sample(description));
  EXPECT_EQ(scan.header.frame_id, "robot/front");
  EXPECT_EQ(scan.beams, 2u);
  EXPECT_EQ(scan.rows, 3u);
  EXPECT_FLOAT_EQ(scan.vertical_angle_min, -0.1f);
  EXPECT_FLOAT_EQ(scan.vertical_angle_increment, 0.1f);
  EXPECT_FLOAT_EQ(scan.angle_increment, static_cast<float>(kPi / 4));
  ASSERT_EQ(scan.ranges.size(), 6u);
  for (const std::size_t row : {0u, 1u, 2u}) {
    const double elevation = 0.1 * (static_cast<double>(row) - 1);
    EXPECT_NEAR(scan.ranges[2 * row], 3.8 / std::cos(elevation), 1e-6) << row;
    EXPECT_EQ(scan.ranges[2 * row + 1], INFINITY) << row;
  }
}

TEST_F(SensorTest, MultiRowLidarAlsoSendsAPointCloud) {
  const auto description = DescriptionOf("lidar", ThreeRows());
  const SensorMessages sent = BuiltInSensors().Find("lidar")->MessagesOf(description);
  ASSERT_TRUE(sent.companion);
  EXPECT_EQ(sent.companion->topic, "points");
  EXPECT_TRUE(sent.companion->of_readings);
  const auto bytes = (*Make(description))->EncodeCompanionOf(Sample(description), "robot/front");
  const auto cloud =
      messages::Decode<messages::sensor_msgs::PointCloud2>(std::as_bytes(std::span(bytes)));
  ASSERT_TRUE(cloud);
  EXPECT_EQ(cloud->height, 3u);
  EXPECT_EQ(cloud->width, 2u);
  ASSERT_EQ(cloud->data.size(), std::size_t{cloud->row_step} * cloud->height);
  const auto value = [&](std::size_t point, std::size_t offset, auto number) {
    std::memcpy(&number, &cloud->data[point * cloud->point_step + offset], sizeof number);
    return number;
  };
  for (const std::size_t row : {0u, 1u, 2u}) {
    const double elevation = 0.1 * (static_cast<double>(row) - 1);
    EXPECT_NEAR(value(2 * row, 0, 0.0f), 3.8, 1e-6);
    EXPECT_NEAR(value(2 * row, 4, 0.0f), 0, 1e-6);
    EXPECT_NEAR(value(2 * row, 8, 0.0f), 3.8 * std::tan(elevation), 1e-6);
    EXPECT_EQ(value(2 * row, cloud->fields.at(3).offset, std::uint16_t{9}), row);
    EXPECT_TRUE(std::isnan(value(2 * row + 1, 0, 0.0f)));
  }
}

TEST_F(SensorTest, LidarNoiseDependsOnSeedAndStepAndHasTheGivenDeviation) {
  auto parameters = Scan(2001, -0.5, 0.5);
  const Reading exact = Sample(DescriptionOf("lidar", parameters));
  parameters["noise.stddev"] = 0.02;
  const Reading noisy = Sample(DescriptionOf("lidar", parameters));
  EXPECT_EQ(Sample(DescriptionOf("lidar", parameters)).values, noisy.values);
  EXPECT_NE(Sample(DescriptionOf("lidar", parameters), 2).values, noisy.values);
  double sum = 0, squares = 0;
  for (std::size_t i = 0; i < exact.values.size(); ++i) {
    const double error = noisy.values[i] - exact.values[i];
    sum += error, squares += error * error;
  }
  EXPECT_NEAR(sum / 2001, 0, 4 * 0.02 / std::sqrt(2001.0));
  EXPECT_NEAR(std::sqrt(squares / 2001), 0.02, 0.002);
}

TEST_F(SensorTest, LidarDropsEchoesAndRoundsOthers) {
  auto parameters = Scan(2000, -0.2, 0.2);
  parameters["noise.stddev"] = 0.02;
  parameters["noise.precision"] = 0.25;
  parameters["noise.dropout_probability"] = 0.1;
  int missed = 0;
  for (const double range : Sample(DescriptionOf("lidar", parameters)).values) {
    missed += range == kInfinity;
    if (range != kInfinity) {
      EXPECT_EQ(4 * range, std::round(4 * range));
    }
  }
  EXPECT_NEAR(missed / 2000.0, 0.1, 3 * std::sqrt(0.1 * 0.9 / 2000));
}

TEST_F(SensorTest, SonarReturnsMaximumRangeForADroppedEcho) {
  EXPECT_EQ(
      Sample(DescriptionOf("sonar", {{"max", 10.0}, {"noise.dropout_probability", 1.0}})).values[0],
      10);
  const double biased =
      Sample(DescriptionOf("sonar", {{"max", 10.0}, {"noise.bias_mean", 0.5}})).values[0];
  EXPECT_NEAR(biased, 4.3, 1e-12);
}

TEST_F(SensorTest, LidarIsDrawnAsTheEndsOfItsBeams) {
  const auto description = DescriptionOf("lidar", Scan(3, -0.2, 0.2));
  const auto beams = (*Make(description))->Beams(Sample(description));
  ASSERT_EQ(beams.size(), 3u);
  for (const Segment& beam : beams) EXPECT_NEAR(beam.to.x, 3.8, 1e-9);
  EXPECT_NEAR(beams[0].to.y, -3.8 * std::tan(0.2), 1e-9);
}

TEST_F(SensorTest, PositioningReadsThePositionOfTheSensor) {
  const auto description = DescriptionOf("positioning");
  const Reading reading = Sample(description);
  ASSERT_EQ(reading.values.size(), 6u);
  EXPECT_NEAR(reading.values[0], 1, 1e-12);
  EXPECT_NEAR(reading.values[1], 0.2, 1e-12);
  EXPECT_NEAR(reading.values[2], 0.3, 1e-12);
  EXPECT_NEAR(reading.values[3], 0, 1e-12);
  EXPECT_NEAR(reading.values[4], 0, 1e-12);
  EXPECT_NEAR(reading.values[5], kPi / 2, 1e-12);
  const auto pose = Decoded<messages::geometry_msgs::PoseStamped>(description, reading);
  EXPECT_EQ(pose.header.frame_id, "map");
  EXPECT_NEAR(pose.pose.position.y, 0.2, 1e-12);
  EXPECT_NEAR(pose.pose.orientation.z, std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(pose.pose.orientation.w, std::sqrt(0.5), 1e-12);
}

TEST_F(SensorTest, PositioningNoiseFollowsItsParameters) {
  double squares = 0;
  for (int step = 0; step < 1000; ++step) {
    snapshot_->state.step = step;
    const double error =
        Sample(DescriptionOf("positioning", {{"noise.position.stddev", 0.5}})).values[0] - 1;
    squares += error * error;
  }
  EXPECT_NEAR(std::sqrt(squares / 1000), 0.5, 0.05);
}

struct BadParameters {
  const char* type;
  model::Parameters parameters;
  const char* sentence;
};

TEST(SensorParameters, InvalidValuesAreRejectedWithASentence) {
  const std::vector<BadParameters> cases = {
      {"sonar", {{"min", 2.0}, {"max", 1.0}}, "sonar front: min (2) is larger than max (1)"},
      {"sonar",
       {{"max", std::nan("")}},
       "sonar front: max is nan; it must lie between 0.001 and 10000"},
      {"sonar", {{"max", std::string("far")}}, "sonar front: max must be a number"},
      {"lidar",
       {{"scan.horizontal.samples", 0.0}},
       "lidar front: scan.horizontal.samples is 0; it must lie between 1 and 1000000"},
      {"lidar",
       {{"scan.horizontal.samples", 2.5}},
       "lidar front: scan.horizontal.samples is 2.5; it must be a whole number"},
      {"lidar",
       {{"scan.horizontal.samples", 2000.0}, {"scan.vertical.samples", 2000.0}},
       "lidar front: the scan has 2000 by 2000 beams; at most 1000000 are allowed"},
      {"lidar",
       {{"scan.horizontal.samples", 2000.0}, {"scan.horizontal.resolution", 1000.0}},
       "lidar front: scan.horizontal asks for 2000000 beams; at most 1000000 are allowed"},
      {"lidar",
       {{"scan.horizontal.min_angle", 1.0}, {"scan.horizontal.max_angle", -1.0}},
       "lidar front: scan.horizontal.min_angle (1) is larger than scan.horizontal.max_angle (-1)"},
      {"lidar", {{"range.min", 20.0}}, "lidar front: range.min (20) is larger than range.max (10)"},
      {"positioning",
       {{"noise.position.stddev", -1.0}},
       "positioning front: noise.position.stddev is -1; it must lie between 0 and 1000"},
  };
  for (const BadParameters& bad : cases) {
    const auto sensor = Make(DescriptionOf(bad.type, bad.parameters));
    ASSERT_FALSE(sensor) << bad.sentence;
    EXPECT_EQ(sensor.error().Sentence(), bad.sentence);
    EXPECT_EQ(sensor.error().code, base::ErrorCode::kInvalidArgument);
  }
}

TEST(SensorRegistry, FindsTypesByNameAndAlias) {
  EXPECT_EQ(BuiltInSensors().names(),
            (std::vector<std::string>{"altimeter", "battery", "contact", "force_torque", "gripper",
                                      "imu", "joint_encoders", "lamp", "lidar", "logical_camera",
                                      "magnetometer", "microphone", "navsat", "odometry",
                                      "positioning", "radio", "ranging", "sonar", "speaker"}));
  EXPECT_EQ(BuiltInSensors().Find("gpu_ray"), BuiltInSensors().Find("lidar"));
  EXPECT_EQ(BuiltInSensors().Find("telepathy"), nullptr);
  EXPECT_EQ(BuiltInSensors().Find("sonar")->schema->name, "sensor_msgs/msg/Range");
}

TEST(SensorRegistry, RejectsADuplicateName) {
  SensorRegistry registry;
  AddBuiltInSensors(registry);
  SensorType type;
  type.name = "scanner";
  type.aliases = {"ray"};
  const auto status = registry.Add(type);
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().message,
            "the sensor type scanner cannot take the name \"ray\": another type has it");
  EXPECT_EQ(registry.Find("scanner"), nullptr);
}

}  // namespace
}  // namespace gsv::sensing
