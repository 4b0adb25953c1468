#include "gsv/gateway/replay/replay_stream.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>

#include <unistd.h>

#include <gtest/gtest.h>

#include "gsv/gateway/live/sensor_topics.h"
#include "gsv/gateway/testing/recording_client.h"
#include "gsv/messages/sensor_msgs.h"
#include "gsv/recording/mcap/mcap_writer.h"

namespace gsv::gateway {
namespace {

using messages::sensor_msgs::Range;
using testing::RecordingClient;

constexpr int kSensors = 20;
constexpr int kListed = static_cast<int>(kMaxSensorTopics) / kSensors;  // robots
constexpr int kWanted = static_cast<int>(kMaxWantedRobots);
constexpr int kRobots = kListed + kWanted + 2;

std::string Robot(int i) { return "robot_" + std::to_string(i); }

// A replay of a recording with more sensors than the stream advertises. Each sensor has one
// reading.
class CrowdReplayTest : public ::testing::Test {
 public:
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

 protected:
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
  // Returns the robots whose last sensor is advertised now.
  std::set<std::string> Listed() const {
    std::map<std::uint64_t, std::string> topics;
    for (const nlohmann::json& text : client_->texts()) {
      if (text["op"] == "unadvertise") {
        for (const auto& id : text["channelIds"]) topics.erase(id.get<std::uint64_t>());
      } else if (text["op"] == "advertise") {
        for (const auto& channel : text["channels"]) {
          topics[channel["id"].get<std::uint64_t>()] = channel["topic"].get<std::string>();
        }
      }
    }
    std::set<std::string> robots;
    const std::string ending = "/sonar_" + std::to_string(kSensors - 1);
    for (const auto& [id, topic] : topics) {
      if (topic.ends_with(ending)) robots.insert(topic.substr(1, topic.size() - 1 - ending.size()));
    }
    return robots;
  }
  bool IsListed(int robot) const { return Listed().contains(Robot(robot)); }

  const std::string path_ =
      ::testing::TempDir() + "gsv_crowd_" + std::to_string(getpid()) + ".mcap";
  std::unique_ptr<recording::McapReader> reader_;
  std::unique_ptr<ReplayStream> stream_;
  std::shared_ptr<RecordingClient> client_ = std::make_shared<RecordingClient>();
};

TEST_F(CrowdReplayTest, AdvertisesTopicsBeyondTwoThousandOnRequest) {
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

TEST_F(CrowdReplayTest, TheFirstRequestedRobotIsRemovedFirstUnlessSubscribed) {
  Want(kListed);
  const auto channel = client_->ChannelOf("/" + Robot(kListed) + "/sonar_0");
  ASSERT_TRUE(stream_->hub()->Receive(client_.get(), testing::SubscribeText(1, channel)));
  for (int robot = kListed + 1; robot < kRobots; ++robot) Want(robot);
  std::set<std::string> expected;
  for (int robot = 0; robot < kRobots; ++robot) expected.insert(Robot(robot));
  expected.erase(Robot(kListed + 1));
  expected.erase(Robot(kListed + 2));
  EXPECT_EQ(Listed(), expected);
}

}  // namespace
}  // namespace gsv::gateway
