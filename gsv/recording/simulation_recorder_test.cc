#include "gsv/recording/simulation_recorder.h"

#include <filesystem>
#include <map>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "gsv/messages/sensor_msgs.h"
#include "gsv/messages/visualization_msgs.h"
#include "gsv/presentation/model_identity.h"
#include "gsv/recording/recording_info.h"
#include "gsv/recording/test_simulation.h"
#include "gsv/sensing/encoding.h"

namespace gsv::recording {
namespace {

using simulation::Phase;

// The name, as bytes: who writes models is no concern of the recorder.
base::Result<std::vector<std::uint8_t>> NameAsGlb(const model::Model& model) {
  return std::vector<std::uint8_t>(model.name.begin(), model.name.end());
}

RecorderOptions Options() {
  RecorderOptions options;
  options.write_glb = &NameAsGlb;
  options.replace = true;
  return options;
}

class SimulationRecorderTest : public testing::Test {
 protected:
  SimulationRecorderTest()
      : path_(testing::TempDir() + "gsv_recorder_" +
              testing::UnitTest::GetInstance()->current_test_info()->name() + ".mcap") {}
  ~SimulationRecorderTest() override { std::filesystem::remove(path_); }

  std::unique_ptr<SimulationRecorder> Start(
      const std::shared_ptr<simulation::Simulation>& simulation) {
    auto recorder = SimulationRecorder::Start(simulation, path_, Options());
    EXPECT_TRUE(recorder) << recorder.error().Sentence();
    return *std::move(recorder);
  }

  // Records a whole run of a second and reads the file.
  RecordingInfo Record(double speed, std::chrono::microseconds dawdling = 0us) {
    auto simulation = MakeSimulation(1s, Drives(speed, dawdling));
    auto recorder = Start(simulation);
    EXPECT_EQ(RunToEnd(*simulation), Phase::kFinished);
    hash_ = simulation->state_hash();
    EXPECT_TRUE(recorder->Stop());
    return Info();
  }

  RecordingInfo Info() const {
    auto info = ReadInfo(path_);
    EXPECT_TRUE(info) << info.error().Sentence();
    for (const base::Problem& problem : info->problems) ADD_FAILURE() << problem.Sentence();
    return *info;
  }

  // All of one topic, decoded.
  template <typename Message>
  std::vector<Message> Read(const std::string& topic) const {
    const auto reader = McapReader::Open(path_);
    EXPECT_TRUE(reader) << reader.error().Sentence();
    std::vector<Message> messages;
    MessageCursor cursor = (*reader)->Messages();
    for (auto next = cursor.Next(); next && *next; next = cursor.Next()) {
      if ((*reader)->summary().channels.at((*next)->channel_id).topic != topic) continue;
      const auto message = messages::Decode<Message>((*next)->data);
      EXPECT_TRUE(message);
      messages.push_back(*message);
    }
    return messages;
  }

  std::vector<Attachment> Attachments(const std::string& name) const {
    const auto reader = McapReader::Open(path_);
    EXPECT_TRUE(reader) << reader.error().Sentence();
    std::vector<Attachment> found;
    for (const AttachmentIndexRecord& index : (*reader)->summary().attachments) {
      if (index.name == name) found.push_back((*reader)->Read(index).value());
    }
    return found;
  }

  nlohmann::json Scene(const Attachment& attachment) const {
    return nlohmann::json::parse(
        reinterpret_cast<const char*>(attachment.data.data()),
        reinterpret_cast<const char*>(attachment.data.data()) + attachment.data.size());
  }

  const std::string path_;
  std::string hash_;  // of the last run that was recorded
};

TEST_F(SimulationRecorderTest, RunsThatGoAlikeHaveTheSameContentHoweverSlowTheBehaviourIs) {
  const std::string first = Record(0.5).content_hash;
  EXPECT_EQ(first.size(), 16u);
  EXPECT_EQ(Record(0.5, 500us).content_hash, first);
  EXPECT_NE(Record(0.4).content_hash, first);
}

TEST_F(SimulationRecorderTest, LeavesNoTraceInTheSimulation) {
  Record(0.5);
  auto simulation = MakeSimulation(1s, Drives(0.5));
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
  EXPECT_EQ(simulation->state_hash(), hash_);
}

TEST_F(SimulationRecorderTest, EachTopicKeepsItsRateInSimulatedTime) {
  std::map<std::string, std::uint64_t> counts;
  for (const auto& channel : Record(0.5).channels) counts[channel.topic] = channel.messages;
  // Over one second, both ends counted: 50, 20, 10 and 5 Hz. "back" is there from the first step
  // on.
  EXPECT_EQ(counts["/clock"], 51u);
  EXPECT_EQ(counts["/gsv/poses"], 51u);
  EXPECT_EQ(counts["/tf"], 51u);
  EXPECT_EQ(counts["/robot/front"], 21u);
  EXPECT_EQ(counts["/robot/back"], 20u);
  EXPECT_EQ(counts["/gsv/beams"], 11u);
  EXPECT_GE(counts["/gsv/status"], 6u);  // and one at the end
  EXPECT_EQ(counts["/gsv/state_hash"], 2u);
  EXPECT_EQ(counts["/tf_static"], 2u);
  EXPECT_EQ(counts["/gsv/events"], 2u);  // started, finished
}

TEST_F(SimulationRecorderTest, TellsWhoMetWhomAndHowHard) {
  Record(4.0);
  const auto contacts = Read<messages::gsv_msgs::Contact>("/gsv/contacts");
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_EQ(contacts[0].first, "robot");
  EXPECT_EQ(contacts[0].second, "wall");
  EXPECT_NEAR(contacts[0].point.x, 2.9, 1e-3);
  EXPECT_NEAR(contacts[0].normal.x, 1, 1e-9);
  EXPECT_NEAR(contacts[0].closing_speed, 4, 1e-9);
}

TEST_F(SimulationRecorderTest, TopicsAndRatesCanBeChosen) {
  auto simulation = MakeSimulation(1s, Drives(0.5));
  RecorderOptions options = Options();
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

TEST_F(SimulationRecorderTest, BeamsAloneAreThoseOfSensorsWithoutATopic) {
  auto simulation = MakeSimulation(1s, Drives(1.0));
  RecorderOptions options = Options();
  options.topics = {"/gsv/beams"};
  auto recorder = SimulationRecorder::Start(simulation, path_, std::move(options));
  ASSERT_TRUE(recorder);
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
  ASSERT_TRUE((*recorder)->Stop());
  ASSERT_EQ(Info().channels.size(), 1u);
  const auto beams = Read<messages::visualization_msgs::MarkerArray>("/gsv/beams");
  ASSERT_EQ(beams.size(), 11u);
  ASSERT_EQ(beams.back().markers.size(), 1u);
  EXPECT_EQ(beams.back().markers[0].points.size(), 4u);  // front and back
}

// A sensor whose picture is one pixel, sent as "jpeg" without data.
sensing::SensorType PixelCamera() {
  class Pixel final : public sensing::Sensor {
   public:
    using Sensor::Sensor;
    base::Result<sensing::Reading> Sample(const sensing::Sampling& sampling) const override {
      sensing::Reading reading = sampling.Stamped();
      auto picture = std::make_shared<model::Image>();
      picture->width = picture->height = 1;
      picture->pixels = {1, 2, 3};
      reading.picture = std::move(picture);
      return reading;
    }
  };
  sensing::SensorType type;
  type.name = "pixel";
  type.create = [](const model::SensorDescription& description) {
    return base::Result<std::unique_ptr<sensing::Sensor>>(std::make_unique<Pixel>(description));
  };
  type.schema = &messages::SchemaOf<messages::sensor_msgs::CompressedImage>();
  type.encode = [](const model::SensorDescription&, const sensing::Reading& reading,
                   const std::string& frame) {
    messages::sensor_msgs::CompressedImage message;
    message.header = sensing::HeaderOf(reading, frame);
    message.format = "jpeg";
    return sensing::Encoded(message);
  };
  return type;
}

TEST_F(SimulationRecorderTest, PicturesCanBePng) {
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
  RecorderOptions options = Options();
  options.write_png = [](const model::Image& picture) {
    return base::Result<std::vector<std::uint8_t>>(picture.pixels);
  };
  auto recorder = SimulationRecorder::Start(simulation, path_, std::move(options));
  ASSERT_TRUE(recorder);
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
  ASSERT_TRUE((*recorder)->Stop());
  const auto pictures = Read<messages::sensor_msgs::CompressedImage>("/robot/eye");
  ASSERT_FALSE(pictures.empty());
  EXPECT_EQ(pictures[0].format, "png");
  EXPECT_EQ(pictures[0].data, (std::vector<std::uint8_t>{1, 2, 3}));
  EXPECT_EQ(pictures[0].header.frame_id, "robot/eye");
}

TEST_F(SimulationRecorderTest, ReadingsAreThoseOfTheirInstant) {
  Record(1.0);
  const auto readings = Read<messages::sensor_msgs::Range>("/robot/front");
  ASSERT_EQ(readings.size(), 21u);
  // From the origin at 1 m/s towards a face at 2.9 m.
  for (std::size_t i = 0; i < readings.size(); ++i) {
    EXPECT_NEAR(readings[i].range, 2.9 - 0.05 * static_cast<double>(i), 1e-6) << i;
    EXPECT_EQ(readings[i].header.frame_id, "robot/front");
  }
}

TEST_F(SimulationRecorderTest, TheSceneSaysWhatThePosesMean) {
  Record(0.5);
  const auto scenes = Attachments("scene.json");
  ASSERT_EQ(scenes.size(), 2u);  // with "back" and before
  const nlohmann::json scene = Scene(scenes.back());
  ASSERT_EQ(scene["bodies"].size(), 2u);
  EXPECT_EQ(scene["bodies"][0]["name"], "robot");
  EXPECT_EQ(scene["bodies"][0]["sensors"].size(), 2u);
  const auto poses = Read<messages::gsv_msgs::Poses>("/gsv/poses");
  ASSERT_FALSE(poses.empty());
  EXPECT_EQ(poses.back().layout_version, scene["layout_version"]);
  ASSERT_EQ(poses.back().poses.size(), 7 * scene["poses"].size());
  EXPECT_NEAR(poses.back().poses[0], 0.5, 1e-9);  // m, after a second at 0.5 m/s
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

TEST_F(SimulationRecorderTest, TheMetadataSayHowToRunItAgainAndHowItEnded) {
  auto info = Record(0.5);
  std::map<std::string, StringMap> metadata;
  for (const MetadataRecord& record : info.metadata) metadata[record.name] = record.values;
  EXPECT_EQ(metadata["gsv.simulation"]["seed"], "7");
  EXPECT_EQ(metadata["gsv.simulation"]["mode"], "lockstep");
  EXPECT_EQ(metadata["gsv.simulation"]["step_ns"], "10000000");
  EXPECT_EQ(metadata["gsv.result"]["phase"], "finished");
  EXPECT_EQ(metadata["gsv.result"]["step"], "100");
  EXPECT_EQ(metadata["gsv.result"]["state_hash"], hash_);
  EXPECT_EQ(metadata["gsv.result"]["dropped_snapshots"], "0");
}

TEST_F(SimulationRecorderTest, ARobotThatComesLaterBringsItsScene) {
  auto simulation = MakeSimulation(1s, Drives(0.5));
  auto recorder = Start(simulation);
  ASSERT_TRUE(simulation->RunUntil(500ms));
  ASSERT_EQ(simulation->WaitForPhase({Phase::kPaused}, kPatience), Phase::kPaused);
  ASSERT_TRUE(simulation->AddRobot(Robot("second", 2, nullptr)));
  ASSERT_TRUE(simulation->Resume());
  ASSERT_EQ(simulation->WaitForPhase({Phase::kFinished}, kPatience), Phase::kFinished);
  ASSERT_TRUE(recorder->Stop());
  const auto poses = Read<messages::gsv_msgs::Poses>("/gsv/poses");
  EXPECT_EQ(poses.front().poses.size(), 7u);
  EXPECT_EQ(poses.back().poses.size(), 14u);
  const auto scenes = Attachments("scene.json");
  const nlohmann::json last = Scene(scenes.back());
  EXPECT_EQ(last["layout_version"], poses.back().layout_version);
  EXPECT_EQ(last["bodies"].size(), 3u);
  EXPECT_EQ(scenes.back().log_time, 510ms);  // the first step with it
}

TEST_F(SimulationRecorderTest, AFullDiskEndsTheRecordingAndNotTheSimulation) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full";
  auto simulation = MakeSimulation(1s, Drives(0.5));
  auto recorder = SimulationRecorder::Start(simulation, "/dev/full", Options());
  ASSERT_TRUE(recorder) << recorder.error().Sentence();
  EXPECT_EQ(RunToEnd(*simulation), Phase::kFinished);
  EXPECT_EQ(simulation->status().step, 100);
  const base::Status stopped = (*recorder)->Stop();
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, base::ErrorCode::kUnavailable);
  EXPECT_NE(stopped.error().Sentence().find("No space left on device"), std::string::npos)
      << stopped.error().Sentence();
  EXPECT_FALSE((*recorder)->is_recording());
}

TEST_F(SimulationRecorderTest, AnExistingFileIsNotOverwrittenUnasked) {
  Record(0.5);
  RecorderOptions options = Options();
  options.replace = false;
  const auto recorder = SimulationRecorder::Start(MakeSimulation(1s, nullptr), path_, options);
  ASSERT_FALSE(recorder);
  EXPECT_EQ(recorder.error().code, base::ErrorCode::kInvalidArgument);
}

TEST_F(SimulationRecorderTest, AResetEndsTheRecording) {
  auto simulation = MakeSimulation(200ms, Drives(0.5));
  auto recorder = Start(simulation);
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
  ASSERT_TRUE(simulation->Reset());
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
  ASSERT_TRUE(recorder->Stop());
  const auto poses = Read<messages::gsv_msgs::Poses>("/gsv/poses");
  ASSERT_GE(poses.size(), 10u);
  for (std::size_t i = 1; i < poses.size(); ++i) EXPECT_GT(poses[i].step, poses[i - 1].step);
  EXPECT_EQ(Read<messages::gsv_msgs::LifecycleEvent>("/gsv/events").back().event, "finished");
}

TEST_F(SimulationRecorderTest, ASimulationThatGoesAwayLeavesAWholeFile) {
  auto simulation = MakeSimulation(200ms, Drives(0.5));
  auto recorder = Start(simulation);
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
  simulation.reset();
  ASSERT_TRUE(recorder->Stop());
  const RecordingInfo info = Info();
  EXPECT_TRUE(info.indexed);
  EXPECT_EQ(info.end, 200ms);
}

}  // namespace
}  // namespace gsv::recording
