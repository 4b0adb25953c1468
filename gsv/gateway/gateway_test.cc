#include "gsv/gateway/gateway.h"

#include <mutex>
#include <thread>

#include <gtest/gtest.h>

#include "gsv/base/test_folder.h"
#include "gsv/gateway/testing/scripted_simulation.h"
#include "gsv/gateway/testing/simulation_list.h"
#include "gsv/gateway/testing/web_client.h"
#include "gsv/messages/gsv_msgs.h"
#include "gsv/messages/sensor_msgs.h"

namespace gsv::gateway {
namespace {

using messages::gsv_msgs::Poses;
using messages::gsv_msgs::SimulationStatus;
using nlohmann::json;
using testing::Decoded;
using testing::Fetch;
using testing::HttpReply;
using testing::ScriptedSimulation;
using testing::Viewer;

class GatewayTest : public ::testing::Test {
 protected:
  void SetUp() override {
    directory_->Add(simulation_);
    Start({});
  }

  void Start(const GatewayOptions& options) {
    auto gateway = Gateway::Start(options, directory_);
    ASSERT_TRUE(gateway) << gateway.error().Sentence();
    gateway_ = std::move(*gateway);
  }
  std::uint16_t port() const { return gateway_->port(); }

  std::shared_ptr<ScriptedSimulation> simulation_ =
      std::make_shared<ScriptedSimulation>("arena", 1);
  std::shared_ptr<testing::SimulationList> directory_ = std::make_shared<testing::SimulationList>();
  std::unique_ptr<Gateway> gateway_;
};

TEST_F(GatewayTest, ServesTheApi) {
  const HttpReply list = Fetch(port(), "GET", "/api/simulations");
  EXPECT_EQ(list.status, 200);
  EXPECT_EQ(json::parse(list.body)[0]["name"], "arena");
  EXPECT_EQ(Fetch(port(), "POST", "/api/simulations/arena/start").status, 200);
  EXPECT_EQ(Fetch(port(), "POST", "/api/simulations/arena/start").status, 409);
  EXPECT_EQ(Fetch(port(), "GET", "/healthz").status, 200);
  EXPECT_EQ(Fetch(port(), "GET", "/ws").status, 426);
  EXPECT_EQ(Fetch(port(), "PUT", "/index.html").headers.at("allow"), "GET");
}

TEST_F(GatewayTest, ViewersCommandTheSimulationByServices) {
  Viewer viewer(port());
  EXPECT_EQ(viewer.CallService("start").first, true);
  EXPECT_EQ(simulation_->status().phase, simulation::Phase::kRunning);
  const auto [again, why] = viewer.CallService("start");
  EXPECT_FALSE(again);
  EXPECT_EQ(why, "the simulation is running and cannot be started");
  EXPECT_TRUE(viewer.CallService("pause").first);
  const std::string three("\0\1\0\0\3\0\0\0\0\0\0\0", 12);
  EXPECT_TRUE(viewer.CallService("step", three).first);
  EXPECT_EQ(simulation_->status().step, 3);
  const std::string moon("\0\1\0\0\xec\x51\xb8\x1e\x85\xeb\xf9\xbf", 12);  // -1.62
  EXPECT_TRUE(viewer.CallService("set_gravity", moon).first);
  EXPECT_EQ(simulation_->gravity(), -1.62);
  EXPECT_TRUE(viewer.CallService("resume").first);
  EXPECT_TRUE(viewer.CallService("stop").first);
  EXPECT_EQ(simulation_->status().phase, simulation::Phase::kStopped);
  EXPECT_TRUE(viewer.CallService("reset").first);
  EXPECT_EQ(simulation_->status().phase, simulation::Phase::kCreated);
  // The server also refuses a page of another origin with the subprotocol foxglove.sdk.v1.
  EXPECT_THROW(Viewer(port(), "/ws", "foxglove.sdk.v1", "http://evil.example"), std::runtime_error);
}

TEST_F(GatewayTest, ViewersCanReadTheParametersOfTheSimulation) {
  Viewer viewer(port());
  viewer.SendText(R"({"op":"subscribeParameterUpdates","parameterNames":["/gsv/phase"]})");
  viewer.SendText(
      R"({"op":"setParameters","parameters":[{"name":"/gsv/seed","value":7}],"id":"a"})");
  EXPECT_EQ(viewer.ReceiveText("status")["message"],
            "the parameter '/gsv/seed' cannot be changed while a simulation runs");
  const json seed = viewer.ReceiveText("parameterValues");
  EXPECT_EQ(seed["parameters"], json::parse(R"([{"name":"/gsv/seed","value":"0"}])"));
  EXPECT_EQ(seed["id"], "a");
  Fetch(port(), "POST", "/api/simulations/arena/start");
  EXPECT_EQ(viewer.ReceiveText("parameterValues")["parameters"],
            json::parse(R"([{"name":"/gsv/phase","value":"running"}])"));
}

TEST_F(GatewayTest, ModelsInTheSceneAreGlbFiles) {
  const json scene = json::parse(Fetch(port(), "GET", "/api/simulations/arena/scene").body);
  for (const json& body : scene["bodies"]) {
    const HttpReply glb =
        Fetch(port(), "GET", "/api/models/" + body["model"].get<std::string>() + ".glb");
    EXPECT_EQ(glb.status, 200);
    ASSERT_GE(glb.body.size(), 20u);
    EXPECT_EQ(glb.body.substr(0, 4), "glTF");
    std::uint32_t length = 0;  // the length of the whole file, in its header
    std::memcpy(&length, &glb.body[8], 4);
    EXPECT_EQ(length, glb.body.size());
  }
}

TEST_F(GatewayTest, ServesTheViewersFiles) {
  const base::testing::TestFolder root;
  root.Write("index.html", "<p>viewer");
  GatewayOptions options;
  options.web_root = root.path();
  Start(options);
  const HttpReply page = Fetch(port(), "GET", "/");
  EXPECT_EQ(page.body, "<p>viewer");
  EXPECT_EQ(Fetch(port(), "GET", "/", "If-None-Match: " + page.headers.at("etag") + "\r\n").status,
            304);
  EXPECT_EQ(Fetch(port(), "GET", "/../../../../etc/passwd").status, 404);
}

TEST_F(GatewayTest, ServesTheDocumentation) {
  EXPECT_EQ(Fetch(port(), "GET", "/docs/").status, 404);
  const base::testing::TestFolder root;
  root.Write("index.html", "<p>documentation");
  GatewayOptions options;
  options.docs_root = root.path();
  Start(options);
  const HttpReply page = Fetch(port(), "GET", "/docs/");
  EXPECT_EQ(page.body, "<p>documentation");
  EXPECT_EQ(page.headers.at("content-security-policy"), "frame-ancestors 'self'");
  EXPECT_EQ(Fetch(port(), "GET", "/").headers.at("content-security-policy"),
            "frame-ancestors 'none'");
}

TEST_F(GatewayTest, AViewerSeesTheRobotsMove) {
  Viewer viewer(port());
  viewer.Subscribe(1, "/gsv/poses");
  const Poses before = Decoded<Poses>(viewer.ReceiveData(1));
  simulation_->Advance(std::chrono::seconds(5));  // one radian
  const Poses after = Decoded<Poses>(viewer.ReceiveData(1));
  ASSERT_EQ(before.poses.size(), 7u * 6);
  EXPECT_NEAR(before.poses[7 * 3], 1, 1e-12);
  EXPECT_NEAR(after.poses[7 * 3], std::cos(1), 1e-12);
  EXPECT_NEAR(after.poses[7 * 3 + 1], std::sin(1), 1e-12);
}

TEST_F(GatewayTest, ViewersCanSubscribeToDifferentTopics) {
  Viewer first(port()), second(port(), "/ws?simulation=arena", "foxglove.websocket.v1");
  first.Subscribe(1, "/gsv/status");
  second.Subscribe(5, "/robot_0/camera");
  EXPECT_EQ(Decoded<SimulationStatus>(first.ReceiveData(1)).state, "created");
  const auto image = Decoded<messages::sensor_msgs::CompressedImage>(second.ReceiveData(5));
  EXPECT_EQ(image.format, "jpeg");
  EXPECT_EQ(image.header.frame_id, "robot_0/camera");
  Fetch(port(), "POST", "/api/simulations/arena/start");
  EXPECT_EQ(Decoded<SimulationStatus>(first.ReceiveData(1)).state, "running");
}

TEST_F(GatewayTest, EachSimulationHasItsOwnStream) {
  directory_->Add(std::make_shared<ScriptedSimulation>("other one", 3));
  Viewer other(port(), "/ws?simulation=other%20one");
  EXPECT_EQ(other.ReceiveText("serverInfo")["metadata"]["simulation"], "other one");
  other.Subscribe(1, "/gsv/poses");
  EXPECT_EQ(Decoded<Poses>(other.ReceiveData(1)).poses.size(), 7u * 12);
  EXPECT_THROW(Viewer(port(), "/ws?simulation=third"), std::runtime_error);
}

TEST_F(GatewayTest, ASlowCameraDoesNotDelayOtherTopics) {
  std::mutex gate;
  std::unique_lock closed(gate);
  simulation_->set_on_watch([&](const std::string& sensor) -> base::Status {
    if (sensor == "camera") std::lock_guard wait(gate);
    return {};
  });
  Viewer viewer(port());
  viewer.Subscribe(1, "/robot_0/camera");
  viewer.Subscribe(2, "/robot_0/front_sonar");
  viewer.Subscribe(3, "/gsv/poses");
  for (int i = 0; i < 3; ++i) {
    viewer.ReceiveData(2);
    viewer.ReceiveData(3);
    simulation_->Advance(std::chrono::milliseconds(10));
  }
  closed.unlock();
  viewer.ReceiveData(1);
}

TEST_F(GatewayTest, ViewersOfADestroyedSimulationAreNotified) {
  Viewer viewer(port());
  viewer.Subscribe(1, "/gsv/poses");
  viewer.ReceiveData(1);
  directory_->Remove("arena");
  while (viewer.Receive()) {
  }
  EXPECT_EQ(viewer.close_code(), 1001);
  EXPECT_EQ(viewer.close_reason(), "the simulation 'arena' does not exist any more");
}

TEST_F(GatewayTest, WithoutASimulationAConnectionIsRefused) {
  directory_->Remove("arena");
  EXPECT_EQ(Fetch(port(), "GET", "/api/simulations").body, "[]");
  const HttpReply refusal = Fetch(port(), "GET", "/ws",
                                  "Connection: Upgrade\r\nUpgrade: websocket\r\n"
                                  "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: AAAA\r\n"
                                  "Sec-WebSocket-Protocol: foxglove.sdk.v1\r\n");
  EXPECT_EQ(refusal.status, 404);
  EXPECT_EQ(json::parse(refusal.body)["error"],
            "there is no simulation yet; create one, then connect again");
}

TEST_F(GatewayTest, APortInUseIsAnError) {
  GatewayOptions options;
  options.port = port();
  const auto other = Gateway::Start(options, directory_);
  ASSERT_FALSE(other);
  EXPECT_NE(other.error().message.find("--port 0"), std::string::npos);
}

TEST_F(GatewayTest, StopSendsTheLastState) {
  Viewer viewer(port());
  viewer.Subscribe(1, "/gsv/status");
  EXPECT_EQ(Decoded<SimulationStatus>(viewer.ReceiveData(1)).state, "created");
  ASSERT_TRUE(simulation_->Start());
  std::thread stopper([&] { gateway_->Stop(); });
  EXPECT_EQ(Decoded<SimulationStatus>(viewer.ReceiveData(1)).state, "running");
  while (viewer.Receive()) {
  }
  stopper.join();
}

TEST_F(GatewayTest, StopsWithManyViewers) {
  simulation_->Advance(std::chrono::seconds(1));
  Viewer first(port()), second(port());
  for (Viewer* viewer : {&first, &second}) {
    viewer->Subscribe(1, "/gsv/poses");
    viewer->Subscribe(2, "/gsv/beams");
    viewer->ReceiveData(1);
  }
  std::thread stopper([&] { gateway_->Stop(); });
  while (first.Receive()) {
  }
  while (second.Receive()) {
  }
  stopper.join();
  EXPECT_EQ(first.close_code(), 1001);
}

}  // namespace
}  // namespace gsv::gateway
