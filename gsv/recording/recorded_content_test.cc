// Tests the content of a simulation's recording, and the selection of topics.
#include <map>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "gsv/messages/gsv_msgs.h"
#include "gsv/messages/sensor_msgs.h"
#include "gsv/messages/tf2_msgs.h"
#include "gsv/messages/visualization_msgs.h"
#include "gsv/presentation/model_identity.h"
#include "gsv/recording/testing/recorder_fixture.h"
#include "gsv/sensing/devices/built_in.h"
#include "gsv/sensing/sensor_type.h"

namespace gsv::recording {
namespace {

using simulation::Phase;

TEST_F(SimulationRecorderTest, TopicsAndRatesCanBeChosen) {
  auto simulation = MakeSimulation(1s, Drives(0.5));
  RecorderOptions options = NamingOptions();
  options.topics = {"/gsv/poses", "/robot/"};
  options.poses_rate = 10;
  options.sensors.readings = 5;
  auto recorder = SimulationRecorder::Start(simulation, path_, std::move(options));
  ASSERT_TRUE(recorder);
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
  ASSERT_TRUE((*recorder)->Stop());
  std::map<std::string, std::uint64_t> counts;
  for (const auto& channel : Info().channels) counts[channel.topic] = channel.messages;
  EXPECT_EQ(counts, (std::map<std::string, std::uint64_t>{
                        {"/gsv/poses", 11}, {"/robot/back", 5}, {"/robot/front", 6}}));
}

TEST_F(SimulationRecorderTest, SensorsOfSeveralRatesKeepTheirInstants) {
  const auto behaviour = std::make_shared<simulation::ThreadBehaviour>(
      [](simulation::Agent& agent, simulation::ClockId clock) {
        for (const int rate : {3, 7}) {
          model::SensorDescription sonar;
          sonar.name = "at_" + std::to_string(rate);
          sonar.type = "sonar";
          sonar.update_rate = rate;
          sonar.parameters = {{"min", 0.1}, {"max", 5.0}};
          EXPECT_TRUE(agent.CreateSensor(sonar));
        }
        while (simulation::SleepFor(agent, clock, 50ms)) {
        }
      });
  auto simulation = MakeSimulation(1s, behaviour);
  auto recorder = Start(simulation);
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
  ASSERT_TRUE(recorder->Stop());
  // The first steps of 10 ms at or after the multiples of 1/3 s and of 1/7 s. There is no reading
  // at 0 s, because the sensors are created later.
  const std::map<std::string, std::vector<unsigned>> expected{
      {"/robot/at_3", {340, 670, 1000}}, {"/robot/at_7", {150, 290, 430, 580, 720, 860}}};
  for (const auto& [topic, instants_ms] : expected) {
    std::vector<unsigned> recorded_ms;
    for (const auto& range : Read<messages::sensor_msgs::Range>(topic)) {
      const messages::builtin_interfaces::Time& stamp = range.header.stamp;
      recorded_ms.push_back(static_cast<unsigned>(stamp.sec) * 1000 + stamp.nanosec / 1'000'000);
    }
    EXPECT_EQ(recorded_ms, instants_ms) << topic;
  }
}

TEST_F(SimulationRecorderTest, BeamsCanBeRecordedWithoutReadings) {
  auto simulation = MakeSimulation(1s, Drives(1.0));
  RecorderOptions options = NamingOptions();
  options.topics = {"/gsv/beams"};
  auto recorder = SimulationRecorder::Start(simulation, path_, std::move(options));
  ASSERT_TRUE(recorder);
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
  ASSERT_TRUE((*recorder)->Stop());
  ASSERT_EQ(Info().channels.size(), 1u);
  const auto beams = Read<messages::visualization_msgs::MarkerArray>("/gsv/beams");
  ASSERT_EQ(beams.size(), 11u);
  ASSERT_EQ(beams.back().markers.size(), 1u);
  // The four points are the ends of the beams of "front" and of "back".
  EXPECT_EQ(beams.back().markers[0].points.size(), 4u);
}

// A sensor whose image is one pixel. Its message has the format "jpeg" and no data.
sensing::SensorType PixelCamera() {
  class Pixel final
      : public sensing::SensorOf<readings::Camera, messages::sensor_msgs::CompressedImage> {
   public:
    Pixel(const model::SensorDescription& description, sensing::ParameterReader&)
        : SensorOf(description) {}
    base::Result<sensing::Reading> Sample(const sensing::Sampling& sampling) const override {
      sensing::Reading reading = sampling.Stamped();
      auto image = std::make_shared<model::Image>();
      image->width = image->height = 1;
      image->pixels = {1, 2, 3};
      Fill(Values{1, 1}, reading);
      reading.image = std::move(image);
      return reading;
    }
    Bytes EncodeCompanion(base::SimTime time, const std::string& frame) const override {
      messages::sensor_msgs::CameraInfo message;
      message.header = sensing::HeaderOf(time, frame);
      message.width = 1;
      return sensing::Encoded(message);
    }

   private:
    Message ToMessage(const Values&, const sensing::Reading&, const std::string&) const override {
      Message message;
      message.format = "jpeg";
      return message;
    }
  };
  auto type = sensing::MakeSensorType<Pixel>("pixel");
  type.companion = {"camera_info", &messages::SchemaOf<messages::sensor_msgs::CameraInfo>()};
  return type;
}

TEST_F(SimulationRecorderTest, ImagesCanBePng) {
  auto types = std::make_shared<sensing::SensorRegistry>();
  sensing::AddBuiltInSensors(*types);
  ASSERT_TRUE(types->Add(PixelCamera()));
  auto simulation = simulation::Simulation::Create(simulation::Lockstep(100ms), types).value();
  simulation::RobotSpecification robot = Robot("robot", 0, nullptr);
  model::Model model = *robot.model;
  model.sensors.resize(1);
  model.sensors[0].name = "eye";
  model.sensors[0].type = "pixel";
  robot.model = std::make_shared<const model::Model>(std::move(model));
  ASSERT_TRUE(simulation->AddRobot(robot));
  RecorderOptions options = NamingOptions();
  options.write_png = [](const model::Image& image) {
    return base::Result<std::vector<std::uint8_t>>(image.pixels);
  };
  auto recorder = SimulationRecorder::Start(simulation, path_, std::move(options));
  ASSERT_TRUE(recorder);
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
  ASSERT_TRUE((*recorder)->Stop());
  const auto images = Read<messages::sensor_msgs::CompressedImage>("/robot/eye");
  ASSERT_FALSE(images.empty());
  EXPECT_EQ(images[0].format, "png");
  EXPECT_EQ(images[0].data, (std::vector<std::uint8_t>{1, 2, 3}));
  EXPECT_EQ(images[0].header.frame_id, "robot/eye");
  // Each image has a companion message, a CameraInfo, of the same instant.
  const auto infos = Read<messages::sensor_msgs::CameraInfo>("/robot/eye/camera_info");
  ASSERT_EQ(infos.size(), images.size());
  EXPECT_EQ(infos.back().header.stamp.nanosec, images.back().header.stamp.nanosec);
  EXPECT_EQ(infos.back().width, 1u);
}

TEST_F(SimulationRecorderTest, ReadingsBelongToTheirInstant) {
  Record(1.0);
  const auto readings = Read<messages::sensor_msgs::Range>("/robot/front");
  ASSERT_EQ(readings.size(), 21u);
  // The robot drives from the origin at 1 m/s towards a wall at 2.9 m.
  for (std::size_t i = 0; i < readings.size(); ++i) {
    EXPECT_NEAR(readings[i].range, 2.9 - 0.05 * static_cast<double>(i), 1e-6) << i;
    EXPECT_EQ(readings[i].header.frame_id, "robot/front");
  }
}

TEST_F(SimulationRecorderTest, LidarOfSeveralRowsIsRecordedAsScanAndPoints) {
  auto simulation = simulation::Make(simulation::Lockstep(100ms));
  simulation::RobotSpecification robot = Robot("robot", 0, nullptr);
  model::Model model = *robot.model;
  model.sensors.resize(1);
  model.sensors[0].name = "rows";
  model.sensors[0].type = "lidar";
  model.sensors[0].parameters = {{"scan.horizontal.samples", 5.0}, {"scan.vertical.samples", 3.0}};
  robot.model = std::make_shared<const model::Model>(std::move(model));
  ASSERT_TRUE(simulation->AddRobot(robot));
  auto recorder = Start(simulation);
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
  ASSERT_TRUE(recorder->Stop());
  const auto scans = Read<messages::gsv_msgs::LidarScan>("/robot/rows");
  ASSERT_FALSE(scans.empty());
  EXPECT_EQ(scans[0].ranges.size(), 15u);
  const auto clouds = Read<messages::sensor_msgs::PointCloud2>("/robot/rows/points");
  ASSERT_EQ(clouds.size(), scans.size());
  EXPECT_EQ(clouds[0].width * clouds[0].height, 15u);
}

// A station is a body with sensors and without a drive.
TEST_F(SimulationRecorderTest, SensorsOfAStationAreRecorded) {
  simulation::Specification specification = simulation::Lockstep(100ms);
  auto world = std::make_shared<model::WorldDescription>(*specification.world);
  auto post = std::make_shared<model::Model>(*simulation::Disc(0.1));
  post->name = "post";
  post->drive.reset();
  world->models.push_back({"post", post, simulation::PlanarPose(0, 2, 0, 0), true});
  specification.world = world;
  auto simulation = simulation::Make(specification);
  auto recorder = Start(simulation);
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
  ASSERT_TRUE(recorder->Stop());
  const auto readings = Read<messages::sensor_msgs::Range>("/post/front");
  ASSERT_FALSE(readings.empty());
  EXPECT_NEAR(readings[0].range, 2.9, 1e-6);
  const auto frames = Read<messages::tf2_msgs::TFMessage>("/tf_static");
  ASSERT_FALSE(frames.empty());
  EXPECT_EQ(frames[0].transforms.at(0).header.frame_id, "post");
  const nlohmann::json scene = Scene(Attachments("scene.json").back());
  EXPECT_EQ(scene["bodies"][0]["is_station"], true);
  EXPECT_EQ(scene["bodies"][0]["sensors"].size(), 1u);
}

TEST_F(SimulationRecorderTest, TheSceneListsTheBodyOfEachPose) {
  Record(0.5);
  const auto scenes = Attachments("scene.json");
  ASSERT_EQ(scenes.size(), 2u);  // the newest scene has the sensor "back", the older one does not
  const nlohmann::json scene = Scene(scenes.back());
  ASSERT_EQ(scene["bodies"].size(), 2u);
  EXPECT_EQ(scene["bodies"][0]["name"], "robot");
  EXPECT_EQ(scene["bodies"][0]["sensors"].size(), 2u);
  const auto poses = Read<messages::gsv_msgs::Poses>("/gsv/poses");
  ASSERT_FALSE(poses.empty());
  EXPECT_EQ(poses.back().layout_version, scene["layout_version"]);
  ASSERT_EQ(poses.back().poses.size(), 7 * scene["poses"].size());
  EXPECT_NEAR(poses.back().poses[0], 0.5, 1e-9);  // x in m, after one second at 0.5 m/s
}

TEST_F(SimulationRecorderTest, EachModelIsAttachedOnce) {
  Record(0.5);
  for (const auto& model : {simulation::Disc(0.2), simulation::Wall()}) {
    const auto files = Attachments(ModelAttachment(presentation::ModelIdentity(*model)));
    ASSERT_EQ(files.size(), 1u) << model->name;
    EXPECT_EQ(
        std::string(reinterpret_cast<const char*>(files[0].data.data()), files[0].data.size()),
        model->name);
    EXPECT_EQ(files[0].media_type, "model/gltf-binary");
  }
}

}  // namespace
}  // namespace gsv::recording
