#include "gsv/gateway/replay/replay_stream.h"

#include <filesystem>
#include <memory>
#include <string>

#include <unistd.h>

#include <gtest/gtest.h>

#include "gsv/gateway/live/sensor_topics.h"
#include "gsv/gateway/testing/recording_client.h"
#include "gsv/messages/sensor_msgs.h"
#include "gsv/recording/mcap_writer.h"

namespace gsv::gateway {
namespace {

using messages::sensor_msgs::Range;
using testing::RecordingClient;

constexpr int kSensors = 20;
constexpr int kListed = static_cast<int>(kMostSensorTopics) / kSensors;  // robots
constexpr int kWanted = static_cast<int>(kMostWantedRobots);
constexpr int kRobots = kListed + kWanted + 2;

std::string Robot(int i) { return "robot_" + std::to_string(i); }

// A recording of more sensors than are listed, with one reading each, and who replays it.
class CrowdReplayTest : public ::testing::Test {
 protected:
  CrowdReplayTest() {
    Write();
    reader_ = recording::McapReader::Open(path_).value();
    stream_ = std::make_unique<ReplayStream>(
        *reader_, "crowd", [] {}, nullptr);
    stream_->hub()->Add(client_);
    stream_->JumpTo({});
    Round();
  }
  ~CrowdReplayTest() override { std::filesystem::remove(path_); }

  void Write() const {
    auto writer = recording::McapWriter::Create(path_, {.replace = true}).value();
    for (int robot = 0; robot < kRobots; ++robot) {
      for (int sensor = 0; sensor < kSensors; ++sensor) {
        Range reading;
        reading.range = static_cast<float>(robot);
        messages::Bytes bytes;
        messages::Encode(reading, bytes);
        const std::string topic = "/" + Robot(robot) + "/sonar_" + std::to_string(sensor);
        const auto channel = writer->AddChannel(topic, messages::SchemaOf<Range>()).value();
        writer->Write(channel, {}, std::as_bytes(std::span(bytes)));
      }
    }
    ASSERT_TRUE(writer->Close());
  }

  void Round() {
    stream_->Publish({}, simulation::Phase::kPaused, {},
                     [] { return simulation::SimulationStatus(); });
  }
  void Want(int robot) {
    stream_->Want(Robot(robot));
    Round();
  }
  // Whether its last sensor is listed now.
  bool IsListed(int robot) const {
    return client_->ChannelOf("/" + Robot(robot) + "/sonar_" + std::to_string(kSensors - 1)) != 0;
  }

  const std::string path_ =
      ::testing::TempDir() + "gsv_crowd_" + std::to_string(getpid()) + ".mcap";
  std::unique_ptr<recording::McapReader> reader_;
  std::unique_ptr<ReplayStream> stream_;
  std::shared_ptr<RecordingClient> client_ = std::make_shared<RecordingClient>();
};

TEST_F(CrowdReplayTest, BeyondTwoThousandTopicsARobotsAreListedWhenItIsWanted) {
  EXPECT_TRUE(IsListed(kListed - 1));
  EXPECT_FALSE(IsListed(kListed));
  Want(kListed);
  ASSERT_TRUE(IsListed(kListed));
  EXPECT_FALSE(IsListed(kListed + 1));
  const auto channel = client_->ChannelOf("/" + Robot(kListed) + "/sonar_0");
  ASSERT_TRUE(stream_->hub()->Receive(client_.get(), testing::SubscribeText(1, channel)));
  Round();
  ASSERT_EQ(client_->data(1).size(), 1u);
  EXPECT_EQ(testing::Decoded<Range>(client_->data(1)[0]).range, static_cast<float>(kListed));
}

TEST_F(CrowdReplayTest, OfTheWantedWhoWasWantedFirstGoesUnlessSomebodyListens) {
  Want(kListed);
  const auto channel = client_->ChannelOf("/" + Robot(kListed) + "/sonar_0");
  ASSERT_TRUE(stream_->hub()->Receive(client_.get(), testing::SubscribeText(1, channel)));
  for (int robot = kListed + 1; robot < kRobots; ++robot) Want(robot);
  EXPECT_TRUE(IsListed(kListed));
  EXPECT_FALSE(IsListed(kListed + 1));
  EXPECT_FALSE(IsListed(kListed + 2));
  for (int robot = kListed + 3; robot < kRobots; ++robot) EXPECT_TRUE(IsListed(robot)) << robot;
}

}  // namespace
}  // namespace gsv::gateway
