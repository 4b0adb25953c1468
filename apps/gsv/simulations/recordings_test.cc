#include "apps/gsv/simulations/recordings.h"

#include <unistd.h>

#include <cerrno>
#include <filesystem>

#include <gtest/gtest.h>

#include "gsv/recording/reading/recording_info.h"
#include "gsv/recording/simulation_recorder.h"
#include "gsv/recording/testing/test_simulation.h"

namespace gsv::app {
namespace {

using recording::operator""s;

class RecordingsTest : public testing::Test {
 public:
  ~RecordingsTest() override { std::filesystem::remove(path_); }

 protected:
  const std::string path_ =
      testing::TempDir() + "gsv_recordings_" + std::to_string(getpid()) + ".mcap";
  std::shared_ptr<simulation::Simulation> simulation_ = recording::MakeSimulation(1s, nullptr);
  Recordings recordings_{testing::TempDir()};
};

TEST(RecordedCommandLine, ContainsNoTokens) {
  EXPECT_EQ(WithoutSecrets({"gsv", "run", "--control-token", "secret", "--watch-token=secret",
                            "--seed", "3", "--token", "secret"}),
            (std::vector<std::string>{"gsv", "run", "--seed", "3"}));
  EXPECT_EQ(WithoutSecrets({"gsv", "--control-token"}), std::vector<std::string>{"gsv"});
}

TEST(RecordingRate, IsSetByKind) {
  RecordingChoice choice;
  EXPECT_TRUE(SetRate("poses=10", choice));
  EXPECT_TRUE(SetRate("pictures=0.5", choice));
  EXPECT_EQ(choice.poses_rate, 10);
  EXPECT_EQ(choice.images_rate, 0.5);
  EXPECT_EQ(choice.readings_rate, 20);
  for (const char* bad : {"", "poses", "poses=", "poses=x", "poses=0", "poses=-1", "poses=1e9",
                          "poses=nan", "poses=1 ", "sounds=1", "=1"}) {
    const base::Status set = SetRate(bad, choice);
    ASSERT_FALSE(set) << bad;
    EXPECT_NE(set.error().Sentence().find("expected poses=HZ"), std::string::npos);
  }
}

TEST_F(RecordingsTest, RecordingContainsTheVersionAndCommandOfItsProgram) {
  ASSERT_TRUE(recordings_.Start(simulation_, path_));
  ASSERT_EQ(recording::RunToEnd(*simulation_), simulation::Phase::kFinished);
  ASSERT_TRUE(recordings_.Stop("simulation"));
  const auto info = recording::ReadInfo(path_);
  ASSERT_TRUE(info);
  EXPECT_EQ(info->duration(), 1s);
  std::map<std::string, recording::StringMap> metadata;
  for (const auto& record : info->metadata) metadata[record.name] = record.values;
  EXPECT_FALSE(metadata["gsv.simulation"]["gsv_version"].empty());
  EXPECT_NE(metadata["gsv.simulation"]["command"].find(program_invocation_short_name),
            std::string::npos);
  // The attachments are the scenario, the scene, and the visuals and collision shapes of the disc
  // and the wall.
  ASSERT_EQ(info->attachments.size(), 6u);
  EXPECT_EQ(info->attachments[0].name, "scenario.yaml");
  EXPECT_TRUE(info->attachments[2].name.starts_with("models/"));
  EXPECT_GT(info->attachments[2].size, 20u);
}

TEST_F(RecordingsTest, ArgumentsAreRecordedOnlyForTheSimulationOfTheCommand) {
  const auto keys = [this] {
    EXPECT_TRUE(recordings_.Start(simulation_, path_));
    EXPECT_TRUE(recordings_.StopAll());
    const recording::RecordingInfo info = recording::ReadInfo(path_).value();
    recording::StringMap values;
    for (const auto& record : info.metadata) {
      if (record.name == "gsv.simulation") values = record.values;
    }
    std::filesystem::remove(path_);
    return values;
  };
  recordings_.SetSimulationOfCommand(simulation_);
  EXPECT_TRUE(keys().contains("arguments"));
  simulation_ = recording::MakeSimulation(1s, nullptr);
  EXPECT_FALSE(keys().contains("arguments"));
}

TEST_F(RecordingsTest, SimulationIsRecordedOnceAtATime) {
  ASSERT_TRUE(recordings_.Start(simulation_, path_));
  const base::Status again = recordings_.Start(simulation_, path_ + ".other");
  ASSERT_FALSE(again);
  EXPECT_EQ(again.error().code, base::ErrorCode::kInvalidArgument);
  EXPECT_NE(again.error().message.find(path_), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(path_ + ".other"));
}

TEST_F(RecordingsTest, NewSimulationWithAReusedNameCanBeRecorded) {
  ASSERT_TRUE(recordings_.Start(simulation_, path_));
  simulation_ = recording::MakeSimulation(1s, nullptr);
  EXPECT_TRUE(recordings_.Start(simulation_, path_ + ".other"));
  EXPECT_TRUE(recordings_.StopAll());
  EXPECT_EQ(recording::ReadInfo(path_).value().indexed, true);
  std::filesystem::remove_all(path_ + ".other");
}

TEST_F(RecordingsTest, NameWithoutExtensionBecomesABagFolder) {
  const std::filesystem::path folder = path_ + ".folder";
  ASSERT_TRUE(recordings_.Start(simulation_, folder));
  ASSERT_TRUE(recordings_.StopAll());
  EXPECT_EQ(recording::ReadInfo(folder).value().indexed, true);
  EXPECT_TRUE(std::filesystem::exists(folder / "metadata.yaml"));
  std::filesystem::remove_all(folder);
}

// Viewers show the path after the end of a run.
TEST_F(RecordingsTest, PathIsKnownAfterAllRecordingsWereStopped) {
  ASSERT_TRUE(recordings_.Start(simulation_, path_));
  ASSERT_EQ(recording::RunToEnd(*simulation_), simulation::Phase::kFinished);
  ASSERT_TRUE(recordings_.StopAll());
  const auto state = recordings_.RecordingOf("simulation");
  EXPECT_EQ(state.path, path_);
  EXPECT_FALSE(state.is_recording);
}

TEST_F(RecordingsTest, SimulationWithoutARecordingCannotBeStopped) {
  EXPECT_EQ(recordings_.Stop("simulation").error().code, base::ErrorCode::kNotFound);
  EXPECT_TRUE(recordings_.StopAll());
}

TEST_F(RecordingsTest, StoppingAllReportsThatTheDiskWasFull) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full";
  ASSERT_TRUE(recordings_.Start(simulation_, "/dev/full"));
  ASSERT_EQ(recording::RunToEnd(*simulation_), simulation::Phase::kFinished);
  const base::Status stopped = recordings_.StopAll();
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().where, "/dev/full");
}

}  // namespace
}  // namespace gsv::app
