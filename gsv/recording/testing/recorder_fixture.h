// For tests of the recorder: records runs of a robot that drives towards a wall, and reads the
// recordings.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "gsv/recording/mcap/mcap_reader.h"
#include "gsv/recording/reading/recording_info.h"
#include "gsv/recording/simulation_recorder.h"
#include "gsv/recording/testing/test_simulation.h"

namespace gsv::recording {

// Replaces WriteGlb in tests: the "GLB" is the model's name.
inline base::Result<std::vector<std::uint8_t>> NameAsGlb(const model::Model& model) {
  return std::vector<std::uint8_t>(model.name.begin(), model.name.end());
}

inline RecorderOptions NamingOptions() {
  RecorderOptions options;
  options.write_glb = &NameAsGlb;
  options.replace = true;
  return options;
}

class SimulationRecorderTest : public ::testing::Test {
 public:
  SimulationRecorderTest()
      : path_(::testing::TempDir() + "gsv_recorder_" +
              ::testing::UnitTest::GetInstance()->current_test_info()->name() + ".mcap") {}
  ~SimulationRecorderTest() override { std::filesystem::remove(path_); }

 protected:
  std::unique_ptr<SimulationRecorder> Start(
      const std::shared_ptr<simulation::Simulation>& simulation) {
    auto recorder = SimulationRecorder::Start(simulation, path_, NamingOptions());
    EXPECT_TRUE(recorder) << recorder.error().Sentence();
    return *std::move(recorder);
  }

  // Records a run of one second, and returns what the file contains.
  RecordingInfo Record(double speed, std::chrono::microseconds dawdling = 0us) {
    auto simulation = MakeSimulation(1s, Drives(speed, dawdling));
    auto recorder = Start(simulation);
    EXPECT_EQ(RunToEnd(*simulation), simulation::Phase::kFinished);
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

  // Returns all messages of one topic, decoded.
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
  std::string hash_;  // state hash of the last run that was recorded
};

}  // namespace gsv::recording
