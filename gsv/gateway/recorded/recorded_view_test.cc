#include "gsv/gateway/recorded/recorded_view.h"

#include <filesystem>

#include <gtest/gtest.h>

#include "gsv/formats/gltf/gltf_writer.h"
#include "gsv/gateway/testing/replay_fixture.h"
#include "gsv/recording/testing/test_recording.h"

namespace gsv::gateway {
namespace {

using namespace std::chrono_literals;

// A robot that drives from the origin at 0.5 m/s for two seconds.
class RecordedViewTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    auto simulation = recording::MakeSimulation(2s, recording::Drives(0.5));
    recording::RecorderOptions options;
    options.write_glb = &formats::WriteGlb;
    auto recorder =
        recording::SimulationRecorder::Start(simulation, testing::PathFor("view"), options);
    ASSERT_TRUE(recorder) << recorder.error().Sentence();
    ASSERT_EQ(recording::RunToEnd(*simulation), simulation::Phase::kFinished);
    ASSERT_TRUE((*recorder)->Stop());
  }
  static void TearDownTestSuite() { std::filesystem::remove(testing::PathFor("view")); }

  // Returns the robot's x at a time.
  double XAt(base::SimTime time) {
    const auto instant = view_.At(time);
    EXPECT_TRUE(instant) << instant.error().Sentence();
    const auto pose = instant->scene->LookupAt(*instant->snapshot).pose("robot");
    EXPECT_TRUE(pose);
    return pose ? pose->position.x : -1;
  }

  const std::unique_ptr<recording::McapReader> reader_ =
      recording::McapReader::Open(testing::PathFor("view")).value();
  const RecordedScene scene_{*reader_};
  RecordedView view_{*reader_, scene_};
};

TEST_F(RecordedViewTest, ShowsTheNewestPosesOfEachInstant) {
  EXPECT_DOUBLE_EQ(XAt(0ms), 0);
  // Poses are recorded every 20 ms, so they may be up to 20 ms old, in which x changes by 0.01 m.
  EXPECT_NEAR(XAt(1000ms), 0.5, 0.011);
  EXPECT_DOUBLE_EQ(XAt(1019ms), XAt(1000ms));
  EXPECT_NEAR(XAt(1020ms) - XAt(1000ms), 0.01, 1e-9);
  EXPECT_NEAR(XAt(2000ms), 1.0, 0.011);
  EXPECT_NEAR(XAt(500ms), 0.25, 0.011);  // backwards, too
  EXPECT_NEAR(XAt(-5s), 0, 0.02);        // before the start, the robot is where the scene was
                                         // recorded
}

TEST_F(RecordedViewTest, ReportsARecordingWithoutAScene) {
  const recording::Bytes bytes = recording::ThreeChunks();
  const auto reader = recording::Open(bytes).value();
  const RecordedScene scene(*reader);
  RecordedView view(*reader, scene);
  const auto instant = view.At(base::SimTime(0));
  ASSERT_FALSE(instant);
  EXPECT_NE(instant.error().message.find("no poses"), std::string::npos);
  const auto posed = view.At(messages::gsv_msgs::Poses{});
  ASSERT_FALSE(posed);
  EXPECT_NE(posed.error().message.find("no scene"), std::string::npos);
}

}  // namespace
}  // namespace gsv::gateway
