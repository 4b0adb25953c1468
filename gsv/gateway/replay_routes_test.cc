// Tests the gateway of a recording.
#include <filesystem>
#include <map>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "gsv/gateway/testing/replay_fixture.h"
#include "gsv/messages/gsv_msgs.h"
#include "gsv/recording/mcap/mcap_file_writer.h"
#include "gsv/recording/testing/test_recording.h"

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

TEST_F(ReplayGatewayTest, ServesOnlyTheRecordedSimulation) {
  const json list = json::parse(Get("/api/simulations").body);
  ASSERT_EQ(list.size(), 1u);
  EXPECT_EQ(list[0]["name"], "simulation");
  EXPECT_EQ(list[0]["mode"], "lockstep");
  EXPECT_EQ(list[0]["phase"], "created");
  EXPECT_EQ(Get("/api/simulations/other").status, 404);
  EXPECT_EQ(Post("robots/robot/drive", "{}").status, 409);
  EXPECT_EQ(Get("/ws").status, 426);
}

TEST_F(ReplayGatewayTest, RefusesRequestsThatEditASimulation) {
  for (const char* const below : {"set_gravity", "robots", "objects", "robots/robot/drive",
                                  "bodies/robot/place", "bodies/robot/joints/lift"}) {
    const HttpReply reply = Post(below, "{}");
    EXPECT_EQ(reply.status, 409) << below;
    EXPECT_EQ(json::parse(reply.body)["error"], "a replay cannot be edited") << below;
  }
}

TEST_F(ReplayGatewayTest, ServesTheSceneAndItsModels) {
  const json scene = json::parse(Get("/api/simulations/simulation/scene").body);
  ASSERT_EQ(scene["bodies"].size(), 2u);
  EXPECT_EQ(scene["bodies"][0]["name"], "robot");
  EXPECT_EQ(scene["bodies"][0]["sensors"].size(), 2u);
  const std::string models[] = {"disc", "wall"};
  for (int i = 0; i < 2; ++i) {
    const HttpReply glb =
        Get("/api/models/" + scene["bodies"][i]["model"].get<std::string>() + ".glb");
    EXPECT_EQ(glb.status, 200);
    EXPECT_EQ(glb.headers.at("content-type"), "model/gltf-binary");
    EXPECT_EQ(glb.body, models[i]);
  }
  EXPECT_EQ(Get("/api/models/0123456789abcdef.glb").status, 404);
}

TEST_F(ReplayGatewayTest, AViewerGetsTheStateBeforeThePlayback) {
  Viewer viewer(port());
  viewer.Subscribe(1, "/gsv/poses");
  viewer.Subscribe(2, "/gsv/status");
  const auto received = ReceiveEach(viewer, {1, 2});
  const Poses poses = Decoded<Poses>(received.at(1));
  ASSERT_EQ(poses.poses.size(), 7u);
  EXPECT_EQ(poses.poses[0], 0);
  const auto status = Decoded<SimulationStatus>(received.at(2));
  EXPECT_EQ(status.state, "created");
  ASSERT_EQ(status.robots.size(), 1u);
  EXPECT_EQ(status.robots[0].name, "robot");
}

// Requests the curve until it was read completely.
json WholeCurve(std::uint16_t port, const std::string& query) {
  const std::string target = "/api/simulations/simulation/curve?" + query;
  for (;;) {
    const HttpReply reply = testing::Fetch(port, "GET", target);
    const json curve = json::parse(reply.body);
    if (reply.status != 200 || curve["done"] == true) return curve;
    std::this_thread::yield();
  }
}

TEST_F(ReplayGatewayTest, ReturnsAValueOverTheWholeRecording) {
  const json x = WholeCurve(port(), "robot=robot&key=x");
  EXPECT_EQ(x["is_whole"], true);
  EXPECT_EQ(x["problem"], "");
  EXPECT_EQ(x["read_to_s"], 2.0);
  const auto times = x["time_s"].get<std::vector<double>>();
  const auto places = x["values"].get<std::vector<double>>();
  ASSERT_EQ(times.size(), places.size());
  ASSERT_GT(times.size(), 30u);
  EXPECT_EQ(times.back(), 2.0);
  // The robot drives at 0.5 m/s. It may start one or two steps of 10 ms late, so its position may
  // be 0.01 m behind.
  for (std::size_t i = 0; i < times.size(); ++i) EXPECT_NEAR(places[i], 0.5 * times[i], 0.011);
  const json speed = WholeCurve(port(), "robot=robot&key=speed&most=4");
  EXPECT_EQ(speed["is_whole"], false);
  EXPECT_LE(speed["values"].size(), 4u);
  EXPECT_NEAR(speed["values"].back(), 0.5, 1e-6);
  EXPECT_EQ(WholeCurve(port(), "key=late_steps")["values"].back(), 0);
}

TEST_F(ReplayGatewayTest, RefusesAMissingCurve) {
  const std::string path = "/api/simulations/simulation/curve";
  EXPECT_EQ(Get(path).status, 400);
  EXPECT_EQ(Get(path + "?robot=other&key=x").status, 404);
  EXPECT_EQ(Get(path + "?topic=/other&key=x").status, 404);
  EXPECT_EQ(Get(path + "?robot=robot&key=x&most=many").status, 400);
  EXPECT_EQ(Post("curve", "{}").status, 405);
}

TEST_F(ReplayGatewayTest, ReturnsTheWholeLog) {
  const json log = json::parse(Get("/api/simulations/simulation/log").body);
  ASSERT_EQ(log.size(), 2u);
  EXPECT_EQ(log[0]["text"], "started");
  EXPECT_EQ(log[0]["name"], "gsv");
  EXPECT_EQ(log[0]["level"], 20);
  EXPECT_EQ(log[1]["text"], "finished");
  EXPECT_EQ(log[1]["time_s"], 2.0);
}

// A request may arrive before the replay has begun to play. The response must have the robots.
TEST_F(ReplayGatewayTest, ListsTheRobotsFromTheStart) {
  for (int i = 0; i < 50; ++i) {
    const auto player = ReplayPlayer::Open(PathFor("run"), {});
    ASSERT_TRUE(player) << player.error().Sentence();
    ASSERT_EQ((*player)->status().robots.size(), 1u);
  }
}

TEST_F(ReplayGatewayTest, PlaysToTheEnd) {
  Open(PathFor("run"), {.speed = 20});
  Viewer viewer(port());
  viewer.Subscribe(1, "/gsv/poses");
  EXPECT_EQ(Decoded<Poses>(viewer.ReceiveData(1)).step, 0u);
  EXPECT_EQ(json::parse(Post("start").body)["phase"], "running");
  Poses poses;
  while (poses.step < 200) {
    const Poses next = Decoded<Poses>(viewer.ReceiveData(1));
    EXPECT_GT(next.step, poses.step);
    poses = next;
  }
  EXPECT_NEAR(poses.poses[0], 1.0, 1e-9);  // m
  viewer.Subscribe(2, "/gsv/status");
  while (Decoded<SimulationStatus>(viewer.ReceiveData(2)).state != "finished") {
  }
  EXPECT_EQ(Post("start").status, 409);
  EXPECT_EQ(json::parse(Post("reset").body)["phase"], "created");
  EXPECT_EQ(Decoded<Poses>(viewer.ReceiveData(1)).step, 0u);
}

TEST_F(ReplayGatewayTest, HasItsOwnServicesAndParameters) {
  Viewer viewer(port());
  EXPECT_TRUE(viewer.CallService("start").first);
  EXPECT_TRUE(viewer.CallService("pause").first);
  EXPECT_FALSE(viewer.CallService("start").first);
  EXPECT_TRUE(viewer.CallService("reset").first);
  viewer.SendText(
      R"({"op":"subscribeParameterUpdates","parameterNames":["/gsv/speed","/gsv/loop"]})");
  viewer.SendText(R"({"op":"setParameters","id":"a","parameters":[
      {"name":"/gsv/speed","value":4},{"name":"/gsv/loop","value":"yes"}]})");
  EXPECT_NE(viewer.ReceiveText("status")["message"].get<std::string>().find("'/gsv/loop'"),
            std::string::npos);
  json values = viewer.ReceiveText("parameterValues");
  while (!values.contains("id")) values = viewer.ReceiveText("parameterValues");
  EXPECT_EQ(values["parameters"][0]["value"], 4.0);
  EXPECT_EQ(values["parameters"][1]["value"], false);
  Post("replay", R"({"loop":true})");
  // The server also sends the change of the speed, in the same message or in an earlier one. So the
  // test reads messages until one contains `loop`.
  json loop;
  while (loop.is_null()) {
    values = viewer.ReceiveText("parameterValues");
    for (const json& parameter : values["parameters"]) {
      if (parameter["name"] == "/gsv/loop") loop = parameter["value"];
    }
  }
  EXPECT_EQ(loop, true);
}

TEST_F(ReplayGatewayTest, ReturnsTheEventsOfTheRun) {
  const json events = json::parse(Get("/api/simulations/simulation/events").body);
  ASSERT_FALSE(events.empty());
  EXPECT_EQ(events.back()["event"], "finished");
  EXPECT_EQ(events.back()["time_s"], 2.0);
  EXPECT_EQ(Post("events").status, 405);
}

TEST_F(ReplayGatewayTest, ReturnsARobotsTopics) {
  const auto topics = [&](const std::string& robot) {
    return Get("/api/simulations/simulation/robots/" + robot + "/topics");
  };
  const auto status = json::parse(Get("/api/simulations/simulation").body);
  ASSERT_EQ(status["robots"].size(), 1u);
  const std::string robot = status["robots"][0]["name"];
  const json listed = json::parse(topics(robot).body)["topics"];
  ASSERT_FALSE(listed.empty());
  for (const json& topic : listed) {
    EXPECT_TRUE(topic.get<std::string>().starts_with("/" + robot + "/")) << topic;
  }
  EXPECT_EQ(topics("nobody").status, 404);
  EXPECT_EQ(Post("robots/" + robot + "/topics").status, 405);
}

TEST_F(ReplayGatewayTest, ARecordingWithoutASceneIsReported) {
  const std::string path = PathFor("bare");
  const recording::Bytes bytes = recording::ThreeChunks();
  auto sink = recording::FileSink::Create(path, true).value();
  ASSERT_TRUE(sink->Write(bytes));
  Open(path, {});
  ASSERT_EQ(player_->problems().size(), 1u);
  EXPECT_NE(player_->problems()[0].message.find("has no scene"), std::string::npos);
  const std::string name = player_->name();
  EXPECT_EQ(name, std::filesystem::path(path).stem().string());
  const HttpReply scene = Get("/api/simulations/" + name + "/scene");
  EXPECT_EQ(scene.status, 404);
  EXPECT_NE(scene.body.find("has no scene"), std::string::npos);
  Viewer viewer(port());
  viewer.Subscribe(1, "/even");
  EXPECT_EQ(viewer.ReceiveData(1).time_ns, 0u);
  std::filesystem::remove(path);
}

TEST_F(ReplayGatewayTest, AFileThatIsNotARecordingIsAnError) {
  EXPECT_EQ(ReplayPlayer::Open("/nowhere.mcap", {}).error().code, base::ErrorCode::kNotFound);
  EXPECT_EQ(ReplayPlayer::Open("/proc/self/exe", {}).error().code, base::ErrorCode::kCorrupt);
}

TEST_F(ReplayGatewayTest, StopsWithAViewer) {
  Viewer viewer(port());
  viewer.Subscribe(1, "/gsv/poses");
  viewer.ReceiveData(1);
  gateway_->Stop();
  while (viewer.Receive()) {
  }
  EXPECT_EQ(viewer.close_code(), 1001);
}

}  // namespace
}  // namespace gsv::gateway
