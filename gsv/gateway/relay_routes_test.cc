#include "gsv/gateway/gateway.h"

#include <thread>

#include <gtest/gtest.h>

#include "gsv/base/temporary_folder.h"
#include "gsv/gateway/testing/scripted_simulation.h"
#include "gsv/gateway/testing/simulation_list.h"
#include "gsv/gateway/testing/web_client.h"
#include "gsv/gateway/upstream/address.h"
#include "gsv/gateway/upstream/protocol.h"
#include "gsv/messages/gsv_msgs.h"
#include "gsv/tls/certificates.h"

namespace gsv::gateway {
namespace {

using messages::gsv_msgs::LifecycleEvent;
using messages::gsv_msgs::Poses;
using messages::gsv_msgs::SimulationStatus;
using nlohmann::json;
using testing::Decoded;
using testing::Fetch;
using testing::HttpReply;
using testing::ScriptedSimulation;
using testing::Viewer;

TEST(UpstreamAddress, IsReadFromAViewersUrl) {
  EXPECT_EQ(upstream::ParseAddress("http://127.0.0.1:8080/")->Authority(), "127.0.0.1:8080");
  EXPECT_EQ(upstream::ParseAddress("http://robot.lan")->Authority(), "robot.lan:80");
  EXPECT_EQ(upstream::ParseAddress("http://[::1]:99")->Authority(), "[::1]:99");
  EXPECT_EQ(upstream::ParseAddress("http://[::1]:99")->host, "::1");
  for (const char* bad : {"", "127.0.0.1:8080", "ftp://a:1/", "https://", "http://", "http://a:0/",
                          "http://a:x", "http://a:65536", "http://a/b", "http://[::1",
                          "http://::1:80", "http://a b:80", "http://[]:80"}) {
    EXPECT_FALSE(upstream::ParseAddress(bad)) << bad;
  }
}

TEST(UpstreamProtocol, RefusesOtherProtocols) {
  for (const char* bad :
       {"", "[]", R"({"op":"advertise"})", R"({"op":"advertise","channels":[{}]})",
        R"({"op":"advertise","channels":[{"id":-1}]})",
        R"({"op":"unadvertise","channelIds":["x"]})"}) {
    EXPECT_FALSE(upstream::ParseServerText(bad)) << bad;
  }
  EXPECT_TRUE(upstream::ParseServerText(R"({"op":"serverInfo"})"));
  EXPECT_FALSE(upstream::ParseServerData(""));
  EXPECT_FALSE(upstream::ParseServerData(std::string(12, '\x01')));
  EXPECT_FALSE(upstream::ParseServerData(std::string(8, '\x02')));
}

class RelayTest : public ::testing::Test {
 protected:
  void SetUp() override {
    directory_->Add(simulation_);
    StartGateway(0);
    auto relay = Gateway::StartRelay({}, {gateway_->url(), "", authority_});
    ASSERT_TRUE(relay) << relay.error().Sentence();
    relay_ = std::move(*relay);
  }

  void StartGateway(std::uint16_t port) {
    GatewayOptions options;
    options.port = port;
    options.tls = tls_;
    auto gateway = Gateway::Start(options, directory_);
    ASSERT_TRUE(gateway) << gateway.error().Sentence();
    gateway_ = std::move(*gateway);
  }
  std::uint16_t port() const { return relay_->port(); }

  std::shared_ptr<ScriptedSimulation> simulation_ =
      std::make_shared<ScriptedSimulation>("arena", 1);
  std::shared_ptr<testing::SimulationList> directory_ = std::make_shared<testing::SimulationList>();
  std::unique_ptr<Gateway> gateway_;
  std::unique_ptr<Gateway> relay_;
  // Empty for plain HTTP.
  TlsFiles tls_;
  std::string authority_;
};

// A relay of an instance that uses HTTPS.
class SecureRelayTest : public RelayTest {
 protected:
  void SetUp() override {
    ASSERT_TRUE(tls::MakeAuthority(folder(), {}));
    ASSERT_TRUE(tls::MakeCertificate(folder(), {"lab", {"127.0.0.1"}, {}}));
    tls_ = {folder() + "/lab.pem", folder() + "/lab-key.pem"};
    authority_ = folder() + "/ca.pem";
    RelayTest::SetUp();
  }
  std::string folder() const { return folder_.path().string(); }

  const base::TemporaryFolder folder_ = *base::TemporaryFolder::Make("gsv-relay");
};

TEST_F(RelayTest, ForwardsRequestsAndResponses) {
  const std::string scene = "/api/simulations/arena/scene";
  const HttpReply here = Fetch(port(), "GET", scene);
  EXPECT_EQ(here.body, Fetch(gateway_->port(), "GET", scene).body);
  const std::string id = json::parse(here.body)["bodies"][0]["model"];
  const HttpReply model = Fetch(port(), "GET", "/api/models/" + id + ".glb");
  EXPECT_EQ(model.body.substr(0, 4), "glTF");
  EXPECT_EQ(model.headers.at("content-type"), "model/gltf-binary");
  EXPECT_EQ(model.headers.at("cache-control"), "public, max-age=31536000, immutable");
  EXPECT_EQ(Fetch(port(), "GET", "/api/models/" + id + ".glb",
                  "If-None-Match: " + model.headers.at("etag") + "\r\n")
                .status,
            304);
  EXPECT_EQ(Fetch(port(), "POST", "/api/simulations/arena/start", "", "{}").status, 200);
  EXPECT_EQ(simulation_->status().phase, simulation::Phase::kRunning);
  const HttpReply again = Fetch(port(), "POST", "/api/simulations/arena/start", "", "{}");
  EXPECT_EQ(again.status, 409);
  EXPECT_EQ(json::parse(again.body)["error"], "the simulation is running and cannot be started");
  Fetch(port(), "POST", "/api/simulations/arena/robots/avatar/drive", "", R"({"linear_m_s":0.5})");
  EXPECT_EQ(simulation_->avatar_command().linear, 0.5);
  EXPECT_EQ(Fetch(port(), "GET", "/", "Origin: http://evil.example\r\n").status, 403);
}

TEST_F(RelayTest, ForwardsServiceCalls) {
  for (const char* target : {"/ws?simulation=arena", "/ws"}) {
    Viewer viewer(port(), target);
    EXPECT_TRUE(viewer.CallService("start").first);
    EXPECT_EQ(simulation_->status().phase, simulation::Phase::kRunning);
    const auto [again, why] = viewer.CallService("start");
    EXPECT_FALSE(again);
    EXPECT_NE(why.find("the simulation is running and cannot be started"), std::string::npos);
    EXPECT_TRUE(viewer.CallService("reset").first);
    const std::string moon("\0\1\0\0\xec\x51\xb8\x1e\x85\xeb\xf9\xbf", 12);  // -1.62
    EXPECT_TRUE(viewer.CallService("set_gravity", moon).first);
    EXPECT_EQ(simulation_->gravity(), -1.62);
  }
  Viewer viewer(port());
  viewer.SendText(R"({"op":"setParameters","parameters":[{"name":"/gsv/seed","value":7}]})");
  EXPECT_EQ(viewer.ReceiveText("status")["message"],
            "a relay cannot set parameters; set them at the other instance");
}

TEST_F(RelayTest, RelaysAtMostSixtyFourSimulations) {
  std::vector<std::unique_ptr<Viewer>> viewers;
  for (int i = 0; i < 65; ++i) {
    const std::string name = "arena_" + std::to_string(i);
    directory_->Add(std::make_shared<ScriptedSimulation>(name, 0));
    const std::string target = "/ws?simulation=" + name;
    if (i < 64) {
      viewers.push_back(std::make_unique<Viewer>(port(), target));
      viewers.back()->ReceiveText("serverInfo");
      continue;
    }
    const HttpReply refused = Fetch(port(), "GET", target,
                                    "Connection: Upgrade\r\nUpgrade: websocket\r\n"
                                    "Sec-WebSocket-Version: 13\r\n"
                                    "Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n"
                                    "Sec-WebSocket-Protocol: foxglove.sdk.v1\r\n");
    EXPECT_EQ(refused.status, 503);
    EXPECT_NE(refused.body.find("too many simulations are open"), std::string::npos)
        << refused.body;
  }
  // A simulation that other viewers still watch accepts a further viewer.
  Viewer another(port(), "/ws?simulation=arena_7");
  another.ReceiveText("serverInfo");
}

TEST_F(RelayTest, SeveralViewersSeeTheRobotsMove) {
  Viewer first(port()), second(port(), "/ws?simulation=arena", "foxglove.websocket.v1");
  first.Subscribe(1, "/gsv/poses");
  second.Subscribe(2, "/gsv/poses");
  EXPECT_NEAR(Decoded<Poses>(first.ReceiveData(1)).poses[7 * 3], 1, 1e-12);
  EXPECT_NEAR(Decoded<Poses>(second.ReceiveData(2)).poses[7 * 3], 1, 1e-12);
  simulation_->Advance(std::chrono::seconds(5));
  const testing::ReceivedData data = first.ReceiveData(1);
  EXPECT_EQ(data.time_ns, 5'000'000'000u);
  EXPECT_NEAR(Decoded<Poses>(data).poses[7 * 3], std::cos(1), 1e-12);
  EXPECT_NEAR(Decoded<Poses>(second.ReceiveData(2)).poses[7 * 3], std::cos(1), 1e-12);
}

TEST_F(RelayTest, ALateViewerOfAPausedSimulationGetsTheStateAndTheEvents) {
  simulation_->AddEvent("one");
  simulation_->AddEvent("two");
  Viewer early(port());
  early.Subscribe(1, "/gsv/poses");
  early.Subscribe(2, "/gsv/events");
  early.ReceiveData(1);
  early.ReceiveData(2);
  early.ReceiveData(2);
  Viewer late(port());
  late.Subscribe(1, "/gsv/poses");
  EXPECT_EQ(Decoded<Poses>(late.ReceiveData(1)).poses.size(), 7u * 6);
  late.Subscribe(2, "/gsv/events");
  EXPECT_EQ(Decoded<LifecycleEvent>(late.ReceiveData(2)).event, "one");
  EXPECT_EQ(Decoded<LifecycleEvent>(late.ReceiveData(2)).event, "two");
}

TEST_F(RelayTest, WaitsForAnInstanceThatIsRestarted) {
  Viewer viewer(port());
  viewer.Subscribe(1, "/gsv/status");
  viewer.ReceiveData(1);
  const std::uint16_t same_port = gateway_->port();
  gateway_.reset();
  EXPECT_NE(viewer.ReceiveText("status")["message"].get<std::string>().find("trying again"),
            std::string::npos);
  EXPECT_EQ(Fetch(port(), "GET", "/api/simulations").status, 503);
  StartGateway(same_port);
  const json channels = viewer.ReceiveText("advertise")["channels"];
  for (const json& channel : channels) {
    if (channel["topic"] == "/gsv/status") {
      viewer.SendText(testing::SubscribeText(7, channel["id"]));
    }
  }
  EXPECT_EQ(Decoded<SimulationStatus>(viewer.ReceiveData(7)).state, "created");
}

TEST_F(RelayTest, ViewersOfADestroyedSimulationAreNotified) {
  Viewer stranger(port(), "/ws?simulation=nobody");
  while (stranger.Receive()) {
  }
  EXPECT_EQ(stranger.close_code(), 1001);
  EXPECT_EQ(stranger.close_reason(), "the simulation 'nobody' does not exist any more");
}

TEST_F(RelayTest, ARelayCanBeRelayed) {
  auto second = Gateway::StartRelay({}, {relay_->url()});
  ASSERT_TRUE(second);
  Viewer viewer((*second)->port());
  viewer.Subscribe(1, "/robot_0/front_sonar");
  viewer.ReceiveData(1);
}

TEST_F(SecureRelayTest, ForwardsRequestsAndTheStream) {
  EXPECT_TRUE(gateway_->url().starts_with("https://"));
  const HttpReply scene = Fetch(port(), "GET", "/api/simulations/arena/scene");
  EXPECT_EQ(scene.status, 200);
  const std::string id = json::parse(scene.body)["bodies"][0]["model"];
  EXPECT_EQ(Fetch(port(), "GET", "/api/models/" + id + ".glb").body.substr(0, 4), "glTF");
  Viewer viewer(port());
  viewer.Subscribe(1, "/gsv/poses");
  EXPECT_NEAR(Decoded<Poses>(viewer.ReceiveData(1)).poses[7 * 3], 1, 1e-12);
  simulation_->Advance(std::chrono::seconds(5));
  EXPECT_NEAR(Decoded<Poses>(viewer.ReceiveData(1)).poses[7 * 3], std::cos(1), 1e-12);
  EXPECT_TRUE(Viewer(port()).CallService("start").first);
  EXPECT_EQ(simulation_->status().phase, simulation::Phase::kRunning);
}

TEST_F(SecureRelayTest, WaitsForAnInstanceThatIsRestarted) {
  Viewer viewer(port());
  viewer.Subscribe(1, "/gsv/status");
  viewer.ReceiveData(1);
  const std::uint16_t same_port = gateway_->port();
  gateway_.reset();
  EXPECT_NE(viewer.ReceiveText("status")["message"].get<std::string>().find("trying again"),
            std::string::npos);
  StartGateway(same_port);
  viewer.ReceiveText("advertise");
}

TEST_F(SecureRelayTest, ReportsAnUntrustedInstance) {
  ASSERT_TRUE(tls::MakeAuthority(folder_.path() / "other", {}));
  const auto refusal = [&](const std::string& url, const std::string& authority) {
    const auto relay = Gateway::StartRelay({}, {url, "", authority});
    return relay ? std::string() : relay.error().Sentence();
  };
  const std::string port = std::to_string(gateway_->port());
  const std::string url = "https://127.0.0.1:" + port + "/";
  EXPECT_EQ(refusal(url, authority_), "");
  for (const std::string& other : {std::string(), folder() + "/other/ca.pem"}) {
    EXPECT_NE(refusal(url, other).find("its certificate is not trusted"), std::string::npos)
        << refusal(url, other);
  }
  EXPECT_NE(refusal("https://localhost:" + port, authority_).find("or is for another name"),
            std::string::npos);
  EXPECT_NE(refusal(url, folder() + "/none.pem").find("none.pem"), std::string::npos);
  EXPECT_NE(refusal("http://127.0.0.1:" + port, "").find("HTTPS only"), std::string::npos);
}

TEST_F(RelayTest, ReportsAnInstanceWithoutTls) {
  const auto relay = Gateway::StartRelay({}, {"https" + gateway_->url().substr(4)});
  ASSERT_FALSE(relay);
  EXPECT_NE(relay.error().Sentence().find("the TLS connection failed"), std::string::npos)
      << relay.error().Sentence();
}

TEST(Relay, AMissingInstanceIsAnError) {
  const auto silent = Gateway::StartRelay({}, {"http://127.0.0.1:1/"});
  ASSERT_FALSE(silent);
  EXPECT_EQ(silent.error().code, base::ErrorCode::kUnavailable);
  EXPECT_NE(silent.error().Sentence().find("http://127.0.0.1:1/"), std::string::npos);
  EXPECT_EQ(Gateway::StartRelay({}, {"127.0.0.1"}).error().code, base::ErrorCode::kInvalidArgument);
}

}  // namespace
}  // namespace gsv::gateway
