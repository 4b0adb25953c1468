#include "gsv/gateway/replay/replay_player.h"

#include <filesystem>
#include <map>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "gsv/gateway/testing/replay_fixture.h"
#include "gsv/messages/gsv_msgs.h"
#include "gsv/messages/sensor_msgs.h"
#include "gsv/messages/time.h"
#include "gsv/messages/visualization_msgs.h"

namespace gsv::gateway {
namespace {

using messages::gsv_msgs::Poses;
using messages::gsv_msgs::SimulationStatus;
using nlohmann::json;
using testing::Decoded;
using testing::HttpReply;
using testing::PathFor;
using testing::ReceiveEach;
using testing::ReplayGatewayTest;
using testing::Viewer;

TEST_F(ReplayGatewayTest, SeeksForwardsAndBack) {
  Viewer viewer(port());
  viewer.Subscribe(1, "/gsv/poses");
  viewer.Subscribe(2, "/robot/front");
  viewer.Subscribe(3, "/gsv/beams");
  ReceiveEach(viewer, {1, 2, 3});
  // The wall is at 2.9 m, and the robot is at 0.5 m/s times the time.
  for (const double time : {1.5, 0.25, 1.0}) {
    const HttpReply reply = Post("seek", json{{"time_s", time}}.dump());
    EXPECT_EQ(reply.status, 200);
    const json status = json::parse(reply.body);
    EXPECT_EQ(status["time_s"], time);
    EXPECT_EQ(status["phase"], "paused");
    const auto received = ReceiveEach(viewer, {1, 2, 3});
    const Poses poses = Decoded<Poses>(received.at(1));
    EXPECT_NEAR(poses.poses[0], 0.5 * time, 0.5 * 0.02);  // poses are recorded at 50 Hz
    const auto range = Decoded<messages::sensor_msgs::Range>(received.at(2));
    EXPECT_NEAR(range.range, 2.9 - 0.5 * time,
                1e-6);  // the 20 Hz sensor has a reading at each of these times
    const auto beams = Decoded<messages::visualization_msgs::MarkerArray>(received.at(3));
    ASSERT_EQ(beams.markers.size(), 1u);
    EXPECT_FALSE(beams.markers[0].points.empty());
  }
  const json robot = json::parse(Get("/api/simulations/simulation").body)["robots"][0];
  EXPECT_NEAR(robot["pose"]["x_m"].get<double>(), 0.5, 1e-9);
}

TEST_F(ReplayGatewayTest, StepsAndPauses) {
  Viewer viewer(port());
  viewer.Subscribe(1, "/gsv/poses");
  viewer.ReceiveData(1);
  EXPECT_EQ(json::parse(Post("step", R"({"count":4})").body)["time_s"], 0.04);
  EXPECT_EQ(Decoded<Poses>(viewer.ReceiveData(1)).step, 4u);
  EXPECT_EQ(Post("pause").status, 200);
  EXPECT_EQ(Post("resume").status, 200);
  EXPECT_EQ(Post("step").status, 409);
  EXPECT_EQ(json::parse(Post("stop").body)["phase"], "created");
}

TEST_F(ReplayGatewayTest, SendsTheStatusAfterEachSeekWhilePaused) {
  Viewer viewer(port());
  viewer.Subscribe(1, "/gsv/status");
  // A playing replay limits the rate of its status. A paused replay sends it after each seek.
  for (const double time : {1.5, 0.25, 1.0, 0.5}) {
    Post("seek", json{{"time_s", time}}.dump());
    SimulationStatus status;
    do {
      status = Decoded<SimulationStatus>(viewer.ReceiveData(1));
    } while (messages::ToSimTime(status.stamp) != base::FromSeconds(time));
    ASSERT_EQ(status.robots.size(), 1u);
    EXPECT_NEAR(status.robots[0].distance_m, 0.5 * time, 0.5 * 0.2);  // the status is recorded at 5
                                                                      // Hz
  }
}

TEST_F(ReplayGatewayTest, StepsOverRecordedPoses) {
  Viewer viewer(port());
  viewer.Subscribe(1, "/gsv/poses");
  viewer.ReceiveData(1);
  Post("seek", R"({"time_s":1})");
  viewer.ReceiveData(1);
  // Poses are recorded at 50 Hz, every two steps of the simulation.
  const auto step = [&](const char* body) {
    return json::parse(Post("step", body).body)["time_s"].get<double>();
  };
  EXPECT_DOUBLE_EQ(step(R"({"poses":10})"), 1.2);
  EXPECT_EQ(Decoded<Poses>(viewer.ReceiveData(1)).step, 120u);
  EXPECT_DOUBLE_EQ(step(R"({"poses":-1})"), 1.18);
  EXPECT_EQ(Decoded<Poses>(viewer.ReceiveData(1)).step, 118u);
  for (const char* body : {R"({"poses":0})", R"({"poses":1.5})", R"({"poses":1001})",
                           R"({"poses":18446744073709551615})"}) {
    EXPECT_EQ(Post("step", body).status, 400) << body;
  }
}

TEST_F(ReplayGatewayTest, AStepOverPosesStopsThePlayback) {
  Post("start");
  EXPECT_EQ(json::parse(Post("step", R"({"poses":1})").body)["phase"], "paused");
}

TEST_F(ReplayGatewayTest, SpeedAndLoopCanBeChanged) {
  json replay = json::parse(Post("replay", R"({"speed":0.25})").body);
  EXPECT_EQ(replay["speed"], 0.25);
  EXPECT_EQ(replay["loop"], false);
  EXPECT_EQ(json::parse(Post("replay", R"({"loop":true})").body)["loop"], true);
  replay = json::parse(Get("/api/simulations/simulation").body)["replay"];
  EXPECT_EQ(replay["speed"], 0.25);
  EXPECT_EQ(replay["loop"], true);
  EXPECT_EQ(replay["end_s"], 2.0);
  for (const char* body : {"", "[]", R"({"speed":0})", R"({"speed":"1"})", R"({"loop":1})"}) {
    EXPECT_EQ(Post("replay", body).status, 400) << body;
  }
}

// Returns a viewer's playback control message (opcode 3), encoded independently of the code.
std::string ControlBytes(bool play, float speed, std::optional<std::uint64_t> seek_ns) {
  std::string bytes = "\x03";
  const auto put = [&](const auto& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  put(static_cast<std::uint8_t>(play ? 0 : 1));
  put(speed);
  put(static_cast<std::uint8_t>(seek_ns ? 1 : 0));
  put(seek_ns.value_or(0));
  put(std::uint32_t{2});
  return bytes + "me";
}

// A message with opcode 5: the state of the playback.
struct StateReceived {
  int status = 0;
  std::uint64_t time_ns = 0;
  float speed = 0;
  bool did_seek = false;
  std::string request;
};
StateReceived ReceiveState(Viewer& viewer) {
  const std::string bytes = viewer.ReceiveBytes(5);
  StateReceived state;
  state.status = bytes.at(1);
  std::memcpy(&state.time_ns, &bytes.at(2), 8);
  std::memcpy(&state.speed, &bytes.at(10), 4);
  state.did_seek = bytes.at(14) != 0;
  state.request = bytes.substr(19);
  return state;
}

// Receives the answer to a request. Changes of the playback are sent to all viewers, and may arrive
// before the answer.
StateReceived ReceiveAnswer(Viewer& viewer) {
  for (;;) {
    StateReceived state = ReceiveState(viewer);
    if (!state.request.empty()) return state;
  }
}

TEST_F(ReplayGatewayTest, AppliesFoxglovesPlaybackControl) {
  Viewer viewer(port());
  const json info = viewer.ReceiveText("serverInfo");
  EXPECT_EQ(info["capabilities"].back(), "playbackControl");
  EXPECT_EQ(info["dataStartTime"], (json{{"sec", 0}, {"nsec", 0}}));
  EXPECT_EQ(info["dataEndTime"], (json{{"sec", 2}, {"nsec", 0}}));
  EXPECT_EQ(ReceiveState(viewer).status, 1);  // paused, at the beginning

  viewer.SendBinary(ControlBytes(false, 0.5, 1'000'000'000));
  StateReceived state = ReceiveAnswer(viewer);
  EXPECT_EQ(state.request, "me");
  EXPECT_EQ(state.status, 1);
  EXPECT_EQ(state.time_ns, 1'000'000'000u);
  EXPECT_EQ(state.speed, 0.5f);
  EXPECT_TRUE(state.did_seek);
  EXPECT_EQ(json::parse(Get("/api/simulations/simulation/replay").body)["time_s"], 1.0);

  viewer.SendBinary(ControlBytes(true, 100, std::nullopt));
  state = ReceiveAnswer(viewer);
  EXPECT_EQ(state.status, 0);
  EXPECT_FALSE(state.did_seek);
  do {
    state = ReceiveState(viewer);
  } while (state.status != 3);  // until the playback reaches its end
  EXPECT_EQ(state.time_ns, 2'000'000'000u);
  EXPECT_EQ(state.request, "");

  viewer.SendBinary(ControlBytes(true, -1, std::nullopt));
  EXPECT_EQ(viewer.ReceiveText("status")["message"], "'speed' must be from 0.001 to 1000");
}

TEST_F(ReplayGatewayTest, ASeekDoesNotSendOldEventsAsNew) {
  Viewer viewer(port());
  viewer.Subscribe(1, "/gsv/events");
  viewer.Subscribe(2, "/gsv/poses");
  ReceiveEach(viewer, {1, 2});  // the current state
  Post("seek", R"({"time_s":2})");
  for (;;) {
    const auto frame = viewer.Receive();
    ASSERT_TRUE(frame);
    if (frame->is_text || frame->data().opcode != 1) continue;
    ASSERT_EQ(frame->data().subscription, 2u);
    break;
  }
  Viewer late(port());
  late.Subscribe(1, "/gsv/events");
  EXPECT_EQ(Decoded<messages::gsv_msgs::LifecycleEvent>(late.ReceiveData(1)).event, "finished");
}

TEST_F(ReplayGatewayTest, ASeekWithoutATimeIsRefused) {
  for (const char* body : {"", "[]", "{}", R"({"time_s":"1"})", R"({"time_s":1e99})"}) {
    EXPECT_EQ(Post("seek", body).status, 400) << body;
  }
  const json timeline = json::parse(Get("/api/simulations/simulation/replay").body);
  EXPECT_EQ(timeline["start_s"], 0.0);
  EXPECT_EQ(timeline["end_s"], 2.0);
}

TEST_F(ReplayGatewayTest, RestartsWithLoop) {
  Open(PathFor("run"), {.speed = 50, .loop = true});
  Viewer viewer(port());
  viewer.Subscribe(1, "/gsv/poses");
  Post("start");
  for (int rounds = 0; rounds < 2;) {
    std::uint64_t before = 0;
    for (;;) {
      const std::uint64_t step = Decoded<Poses>(viewer.ReceiveData(1)).step;
      if (step < before) break;
      before = step;
    }
    ++rounds;
  }
  EXPECT_EQ(json::parse(Get("/api/simulations/simulation").body)["phase"], "running");
}

}  // namespace
}  // namespace gsv::gateway
