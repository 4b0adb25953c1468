#include "gsv/recording/topics/topics.h"

#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gsv/recording/reading/recording_info.h"
#include "gsv/recording/simulation_recorder.h"
#include "gsv/recording/testing/test_simulation.h"

namespace gsv::recording {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(Topics, AreThoseOfACompleteRecording) {
  const std::string path = ::testing::TempDir() + "gsv_topics.mcap";
  const auto simulation = MakeSimulation(1s, Drives(0.5));
  RecorderOptions options;
  options.write_glb = [](const model::Model&) {
    return base::Result<std::vector<std::uint8_t>>(std::vector<std::uint8_t>(1));
  };
  options.replace = true;
  const auto recorder = SimulationRecorder::Start(simulation, path, std::move(options));
  ASSERT_TRUE(recorder);
  ASSERT_EQ(RunToEnd(*simulation), simulation::Phase::kFinished);
  ASSERT_TRUE((*recorder)->Stop());
  const auto info = ReadInfo(path);
  ASSERT_TRUE(info);
  std::vector<std::string> recorded;
  for (const auto& channel : info->channels) recorded.push_back(channel.topic);
  std::sort(recorded.begin(), recorded.end());
  EXPECT_EQ(TopicsOf(*simulation), recorded);
  std::filesystem::remove(path);
}

TEST(Topics, PatternSelectsATopicOrAllBelowIt) {
  const std::vector<std::string> topics{"/clock", "/gsv/poses", "/robot/front"};
  EXPECT_THAT(UnmatchedPatterns(topics, {"/clock", "/gsv/", "/robot/", "/robot/front"}), IsEmpty());
  EXPECT_THAT(UnmatchedPatterns(topics, {"/robot", "/clock", "/robot/front/", "/rob"}),
              ElementsAre("/robot", "/robot/front/", "/rob"));
  EXPECT_THAT(UnmatchedPatterns({}, {"/"}), ElementsAre("/"));
}

}  // namespace
}  // namespace gsv::recording
