#include "gsv/gateway/history/history_api.h"

#include <thread>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "gsv/base/temporary_folder.h"
#include "gsv/gateway/gateway.h"
#include "gsv/gateway/recordings/note_request.h"
#include "gsv/gateway/testing/replay_fixture.h"
#include "gsv/gateway/testing/simulation_list.h"

namespace gsv::gateway::history {
namespace {

using nlohmann::json;
using std::chrono_literals::operator""h;
using testing::HttpReply;

// A server that keeps the past of a simulation in which a robot drives towards a wall at 2 m/s.
class HistoryApiTest : public ::testing::Test {
 protected:
  void Serve(std::size_t history_bytes = 1 << 20) {
    auto list = std::make_shared<testing::SimulationList>();
    list->Add(simulation_);
    GatewayOptions options;
    options.recordings_folder = folder_.path();
    options.history_bytes = history_bytes;
    auto started = Gateway::Start(options, list);
    ASSERT_TRUE(started) << started.error().Sentence();
    gateway_ = *std::move(started);
  }
  void Advance(int steps) {
    ASSERT_TRUE(simulation_->Step(steps));
    (void)simulation_->WaitForPhase({simulation::Phase::kPaused}, recording::kTimeout);
  }
  HttpReply Get(const std::string& target) const {
    return testing::Fetch(gateway_->port(), "GET", target);
  }
  HttpReply Post(const std::string& target, const std::string& body = "{}") const {
    return testing::Fetch(gateway_->port(), "POST", target, "", body);
  }
  // Waits until the server keeps the run up to `time`, in seconds.
  void WaitUntilKept(double time) const {
    while (json::parse(Get(kSimulation + "/history").body)["end_s"].get<double>() < time) {
      std::this_thread::yield();
    }
  }

  const std::string kSimulation = "/api/simulations/simulation";
  const std::shared_ptr<simulation::Simulation> simulation_ =
      recording::MakeSimulation(1h, recording::Drives(2));
  base::TemporaryFolder folder_ = base::TemporaryFolder::Make("gsv-history-").value();
  std::unique_ptr<Gateway> gateway_;
};

TEST_F(HistoryApiTest, OpensThePastAsAReplayWhileTheRunContinues) {
  Serve();
  Advance(100);
  WaitUntilKept(1);
  const HttpReply opened = Post(kSimulation + "/history");
  ASSERT_EQ(opened.status, 201) << opened.body;
  const std::string past = "/" + json::parse(opened.body)["base"].get<std::string>();
  Advance(100);
  const json status = json::parse(Get(past + "api/simulations/simulation").body);
  EXPECT_EQ(status["replay"]["end_s"], 1.0);
  EXPECT_EQ(json::parse(Get(kSimulation).body)["time_s"], 2.0);
  EXPECT_EQ(Post(past + "api/simulations/simulation/seek", R"({"time_s": 0.5})").status, 200);
  EXPECT_EQ(json::parse(Get(kSimulation).body)["time_s"], 2.0);
  // The replay of the past has the same models as the simulation.
  const json scene = json::parse(Get(past + "api/simulations/simulation/scene").body);
  ASSERT_EQ(scene["bodies"].size(), 2u);
  const std::string model = scene["bodies"][0]["model"];
  (void)Get(kSimulation + "/scene");
  EXPECT_EQ(Get(past + "api/models/" + model + ".glb").body,
            Get("/api/models/" + model + ".glb").body);
}

TEST_F(HistoryApiTest, EventsIncludeCollisionsAndNotes) {
  Serve();
  Advance(200);
  const HttpReply added =
      Post(kSimulation + "/notes", R"({"text": "slow\nhere", "time_s": 0.25, "author": "Ada"})");
  EXPECT_EQ(added.status, 201) << added.body;
  EXPECT_EQ(json::parse(added.body)["time_s"], 0.25);
  EXPECT_EQ(json::parse(Post(kSimulation + "/notes", R"({"text": "now"})").body)["time_s"], 2.0);
  WaitUntilKept(2);
  json collision, note;
  while (collision.is_null()) {
    for (const json& event : json::parse(Get(kSimulation + "/events").body)) {
      if (event["event"] == "collision") collision = event;
      if (event["event"] == "note" && event["time_s"] == 0.25) note = event;
    }
  }
  EXPECT_EQ(collision["robot"], "robot");
  // Notes are selected by the time at which they were made, not by the instant to which they refer.
  const json late = json::parse(Get(kSimulation + "/events?from_s=2").body);
  EXPECT_TRUE(std::any_of(late.begin(), late.end(),
                          [](const json& event) { return event["time_s"] == 0.25; }));
  EXPECT_FALSE(std::any_of(late.begin(), late.end(),
                           [](const json& event) { return event["event"] == "started"; }));
  EXPECT_EQ(Get(kSimulation + "/events?from_s=-1").status, 400);
  EXPECT_EQ(collision["detail"], "robot touches wall");
  EXPECT_EQ(note["detail"], "Ada: slow here");
  // The replay of the past has the same events.
  const std::string past =
      "/" + json::parse(Post(kSimulation + "/history").body)["base"].get<std::string>();
  std::set<std::string> kinds;
  for (const json& event : json::parse(Get(past + "api/simulations/simulation/events").body)) {
    kinds.insert(event["event"].get<std::string>());
  }
  EXPECT_TRUE(kinds.contains("collision"));
  EXPECT_TRUE(kinds.contains("note"));
}

TEST_F(HistoryApiTest, InvalidNotesAreRefused) {
  Serve();
  const std::string too_long(recordings::kMaxNoteLength + 1, 'x');
  for (const std::string& body :
       {std::string("{}"), std::string("[]"), std::string(R"({"text": ""})"),
        std::string(R"({"text": 3})"), std::string(R"({"text": "a", "time_s": -1})"),
        std::string(R"({"text": "a", "time_s": "x"})"), R"({"text": ")" + too_long + "\"}"}) {
    EXPECT_EQ(Post(kSimulation + "/notes", body).status, 400) << body;
  }
  EXPECT_EQ(Post("/api/simulations/other/notes", R"({"text": "a"})").status, 404);
}

TEST_F(HistoryApiTest, ReturnsTheReasonIfNoHistoryIsKept) {
  Serve(0);
  Advance(10);
  for (const HttpReply& reply : {Get(kSimulation + "/history"), Post(kSimulation + "/history")}) {
    EXPECT_EQ(reply.status, 404);
    EXPECT_NE(reply.body.find("--history"), std::string::npos);
  }
  EXPECT_EQ(Get(kSimulation + "/events").status, 200);
}

}  // namespace
}  // namespace gsv::gateway::history
