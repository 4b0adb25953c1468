// For tests of replays: a recorded run, and a gateway that shows it.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "gsv/gateway/gateway.h"
#include "gsv/gateway/replay/replay_player.h"
#include "gsv/gateway/testing/web_client.h"
#include "gsv/recording/simulation_recorder.h"
#include "gsv/recording/testing/test_simulation.h"

namespace gsv::gateway::testing {

// Writes the model's name instead of a GLB file.
inline base::Result<std::vector<std::uint8_t>> NameAsGlb(const model::Model& model) {
  return std::vector<std::uint8_t>(model.name.begin(), model.name.end());
}

// Returns the path of a recording in the folder for temporary files.
inline std::string PathFor(const std::string& name) {
  return ::testing::TempDir() + "gsv_replay_" + std::to_string(getpid()) + "_" + name + ".mcap";
}

// Records two seconds of a robot that drives from the origin towards a wall at `speed`, in m/s.
inline void RecordRun(const std::string& path, double speed = 0.5) {
  auto simulation = recording::MakeSimulation(std::chrono::seconds(2), recording::Drives(speed));
  recording::RecorderOptions options;
  options.write_glb = &NameAsGlb;
  auto recorder = recording::SimulationRecorder::Start(simulation, path, options);
  ASSERT_TRUE(recorder) << recorder.error().Sentence();
  ASSERT_EQ(recording::RunToEnd(*simulation), simulation::Phase::kFinished);
  ASSERT_TRUE((*recorder)->Stop());
}

// Receives one message of each of these subscriptions, in any order.
inline std::map<int, ReceivedData> ReceiveEach(Viewer& viewer, std::set<int> subscriptions) {
  std::map<int, ReceivedData> received;
  while (!subscriptions.empty()) {
    const auto frame = viewer.Receive();
    if (!frame) throw std::runtime_error("the connection ended");
    if (frame->is_text || frame->data().opcode != 1) continue;
    const int id = static_cast<int>(frame->data().subscription);
    if (subscriptions.erase(id) > 0) received[id] = frame->data();
  }
  return received;
}

class ReplayGatewayTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { RecordRun(PathFor("run")); }
  static void TearDownTestSuite() { std::filesystem::remove(PathFor("run")); }

  void SetUp() override { Open(PathFor("run"), {}); }
  void TearDown() override {
    gateway_.reset();
    player_.reset();
  }

  void Open(const std::string& path, const ReplayOptions& options) {
    TearDown();
    auto player = ReplayPlayer::Open(path, options);
    ASSERT_TRUE(player) << player.error().Sentence();
    player_ = *std::move(player);
    auto gateway = Gateway::StartReplay({}, *player_);
    ASSERT_TRUE(gateway) << gateway.error().Sentence();
    gateway_ = *std::move(gateway);
  }

  std::uint16_t port() const { return gateway_->port(); }
  HttpReply Get(const std::string& target) const { return Fetch(port(), "GET", target); }
  // Requests an action of the replay, such as "pause".
  HttpReply Post(const std::string& action, const std::string& body = "") const {
    return Fetch(port(), "POST", "/api/simulations/simulation/" + action, "", body);
  }

  std::unique_ptr<ReplayPlayer> player_;
  std::unique_ptr<Gateway> gateway_;
};

}  // namespace gsv::gateway::testing
