// For tests of live streams.
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include "gsv/gateway/live/live_stream.h"
#include "gsv/gateway/testing/recording_client.h"
#include "gsv/gateway/testing/scripted_simulation.h"

namespace gsv::gateway::testing {

// A live stream of one robot, which drives on a circle of radius 1 m at 0.2 rad/s. The test
// advances the wall clock.
class LiveStreamTest : public ::testing::Test {
 protected:
  void SetUp() override { stream_.hub()->Add(client_); }
  void TearDown() override { workers_.Stop(); }

  // Advances the wall clock and runs one round of the stream.
  void Round(std::chrono::milliseconds later = std::chrono::milliseconds(34)) {
    now_ += later;
    stream_.Round(simulation_, now_);
  }

  void Subscribe(foxglove::SubscriptionId id, const std::string& topic) {
    Subscribe(*client_, id, topic);
  }
  void Subscribe(RecordingClient& client, foxglove::SubscriptionId id, const std::string& topic) {
    const foxglove::ChannelId channel = client.ChannelOf(topic);
    ASSERT_NE(channel, 0u) << topic;
    ASSERT_TRUE(stream_.hub()->Receive(&client, SubscribeText(id, channel)));
  }

  // Calls Round() until `count` messages of the subscription have come from worker threads. Returns
  // the last of these messages.
  ReceivedData RoundUntil(foxglove::SubscriptionId id, std::size_t count) {
    while (client_->data(id).size() < count) {
      Round(std::chrono::milliseconds(1));
      std::this_thread::yield();
    }
    return client_->data(id)[count - 1];
  }

  // The number of status messages with this sentence that the client has received.
  std::size_t WarningCount(const std::string& sentence) const {
    const auto texts = client_->texts();
    return static_cast<std::size_t>(
        std::count_if(texts.begin(), texts.end(),
                      [&](const auto& text) { return text.value("message", "") == sentence; }));
  }

  WallTime now_{};  // time of the last Round(), set by the tests
  WorkerPool workers_{1, 8};
  std::shared_ptr<ScriptedSimulation> simulation_ =
      std::make_shared<ScriptedSimulation>("arena", 1);
  LiveStream stream_{simulation_, workers_, workers_, nullptr, [] {}};
  std::shared_ptr<RecordingClient> client_ = std::make_shared<RecordingClient>();
};

}  // namespace gsv::gateway::testing
