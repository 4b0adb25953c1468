// Tests permissions over HTTP and WebSocket: tokens, and control.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "gsv/gateway/access/viewers_api.h"
#include "gsv/gateway/gateway.h"
#include "gsv/gateway/testing/fake_factory.h"
#include "gsv/gateway/testing/scripted_simulation.h"
#include "gsv/gateway/testing/simulation_list.h"
#include "gsv/gateway/testing/web_client.h"

namespace gsv::gateway::access {
namespace {

using nlohmann::json;
using testing::HttpReply;
using testing::Viewer;

constexpr const char* kControl = "control-token-0123456789";
constexpr const char* kWatch = "watching-token-0123456789";

TEST(Tokens, AreEqualOnlyIfAllCharactersAreEqual) {
  EXPECT_TRUE(EqualsSecret("abc", "abc"));
  for (const char* other : {"", "ab", "abd", "abcd", "Abc"})
    EXPECT_FALSE(EqualsSecret(other, "abc"));
  EXPECT_EQ(BearerToken("Bearer abc"), "abc");
  EXPECT_EQ(BearerToken("Basic abc"), "");
}

TEST(Tokens, AreRefusedIfTheyAreShortOrNotAllowedInAHeader) {
  EXPECT_TRUE(CheckToken(kControl));
  for (const std::string& bad :
       {std::string(), std::string("short"), std::string("with blanks in it"),
        std::string("sixteen-or-more\n"), std::string(257, 'a')}) {
    const base::Status status = CheckToken(bad);
    ASSERT_FALSE(status) << bad;
    EXPECT_TRUE(bad.empty() || status.error().Sentence().find(bad) == std::string::npos);
  }
}

TEST(Tokens, GivePermissions) {
  const auto permissions = [](const TokenAuthenticator& tokens) {
    return std::vector{tokens.PermissionOf(""), tokens.PermissionOf("wrong"),
                       tokens.PermissionOf(kWatch), tokens.PermissionOf(kControl)};
  };
  const Permission none = Permission::kNone, watch = Permission::kWatch,
                   control = Permission::kControl;
  EXPECT_EQ(permissions({{}, false}), (std::vector{control, control, control, control}));
  EXPECT_EQ(permissions({{}, true}), (std::vector{none, none, none, none}));
  EXPECT_EQ(permissions({{kControl, ""}, false}), (std::vector{watch, none, none, control}));
  EXPECT_EQ(permissions({{kControl, ""}, true}), (std::vector{none, none, none, control}));
  EXPECT_EQ(permissions({{kControl, kWatch}, false}), (std::vector{none, none, watch, control}));
  EXPECT_EQ(permissions({{"", kWatch}, true}), (std::vector{none, none, watch, none}));
}

TEST(Permissions, FollowTheRoute) {
  const auto directory = std::make_shared<testing::SimulationList>();
  testing::FakeFactory factory(*directory);
  GatewayOptions options;
  options.factory = &factory;
  options.recordings_folder = ::testing::TempDir();
  const auto gateway = Gateway::Start(options, directory).value();
  // The permission that a request needs, and the simulation whose control it needs ("": none).
  using Taken = std::pair<Permission, std::string>;
  const auto taken = [&](const char* method, const char* target) {
    const Router::Match match = gateway->router().Find(method, ParseTarget(target).value());
    const bool needs_control = match.route != nullptr && match.route->needs_control;
    return Taken(match.permission, needs_control ? match.parameters.at("name") : "");
  };
  const auto none = Permission::kNone, watch = Permission::kWatch, control = Permission::kControl;
  EXPECT_EQ(taken("GET", "/"), Taken(none, ""));
  EXPECT_EQ(taken("GET", "/healthz"), Taken(none, ""));
  EXPECT_EQ(taken("GET", "/metrics"), Taken(watch, ""));
  EXPECT_EQ(taken("GET", "/api/simulations/a"), Taken(watch, ""));
  EXPECT_EQ(taken("POST", "/replays/1/api/simulations/a/seek"), Taken(watch, ""));
  EXPECT_EQ(taken("POST", "/api/recordings/a/replay"), Taken(watch, ""));
  EXPECT_EQ(taken("POST", "/api/viewers"), Taken(watch, ""));
  EXPECT_EQ(taken("POST", "/api/viewers/me/control"), Taken(control, ""));
  EXPECT_EQ(taken("POST", "/api/preview"), Taken(control, ""));
  EXPECT_EQ(taken("POST", "/api/simulations"), Taken(control, ""));
  EXPECT_EQ(taken("PUT", "/api/uploads/1/a.sdf"), Taken(control, ""));
  EXPECT_EQ(taken("DELETE", "/api/simulations/a%20b"), Taken(control, "a b"));
  EXPECT_EQ(taken("POST", "/%61pi/simulations/a/pause"), Taken(control, "a"));
  EXPECT_EQ(taken("POST", "/api/simulations/a/bodies/b/place"), Taken(control, "a"));
  // Requests without a route need the same permission as the routes with similar paths.
  for (const char* method : {"GET", "POST", "PATCH", "NONSENSE"}) {
    EXPECT_EQ(taken(method, "/api/simulations/a/b/c"), Taken(watch, "")) << method;
    EXPECT_EQ(taken(method, "/replays/1"), Taken(watch, "")) << method;
  }
  // Every request that affects other viewers needs control.
  for (const Route& route : gateway->router().routes()) {
    const bool is_private = route.pattern.starts_with("/replays/") ||
                            route.pattern.starts_with("/api/recordings") ||
                            route.pattern.starts_with("/api/viewers") ||
                            route.pattern.ends_with("/history");  // opens a replay that belongs to
                                                                  // this viewer alone
    if (route.method == "GET" || is_private) continue;
    EXPECT_EQ(route.permission, control) << route.pattern;
    EXPECT_EQ(route.needs_control, route.pattern.find("{name}") != std::string::npos)
        << route.pattern;
  }
}

class AccessTest : public ::testing::Test {
 protected:
  void Start(const Tokens& tokens, const std::string& host = "127.0.0.1") {
    directory_->Add(simulation_);
    GatewayOptions options;
    options.tokens = tokens;
    options.host = host;
    auto gateway = Gateway::Start(options, directory_);
    ASSERT_TRUE(gateway) << gateway.error().Sentence();
    gateway_ = *std::move(gateway);
  }

  static std::string Bearer(const std::string& token) {
    return "Authorization: Bearer " + token + "\r\n";
  }
  static std::string As(const std::string& viewer) { return "Gsv-Viewer: " + viewer + "\r\n"; }
  HttpReply Send(const std::string& method, const std::string& target,
                 const std::string& headers = "", const std::string& body = "{}") const {
    return testing::Fetch(gateway_->port(), method, target, headers, method == "GET" ? "" : body);
  }
  int Reset(const std::string& headers = "") const {
    return Send("POST", "/api/simulations/arena/reset", headers).status;
  }
  std::string Enter(const std::string& name) const {
    const HttpReply reply = Send("POST", "/api/viewers", entering_,
                                 json{{"name", name}, {"simulation", "arena"}}.dump());
    EXPECT_EQ(reply.status, 201) << reply.body;
    return json::parse(reply.body)["key"];
  }

  const std::shared_ptr<testing::SimulationList> directory_ =
      std::make_shared<testing::SimulationList>();
  const std::shared_ptr<testing::ScriptedSimulation> simulation_ =
      std::make_shared<testing::ScriptedSimulation>("arena", 1);
  std::string entering_;  // headers
  std::unique_ptr<Gateway> gateway_;
};

TEST_F(AccessTest, WithoutATokenTheServerListensOnlyOnThisMachine) {
  for (const char* host : {"0.0.0.0", "::"}) {
    GatewayOptions options;
    options.host = host;
    const auto refused = Gateway::Start(options, directory_);
    ASSERT_FALSE(refused) << host;
    EXPECT_EQ(refused.error().code, base::ErrorCode::kInvalidArgument);
    EXPECT_NE(refused.error().message.find("--control-token"), std::string::npos);
  }
}

TEST_F(AccessTest, WatchingNeedsNoTokenOnThisMachineButControlDoes) {
  Start({kControl, ""});
  EXPECT_EQ(Send("GET", "/api/simulations").status, 200);
  const HttpReply missing = Send("POST", "/api/simulations/arena/start");
  EXPECT_EQ(missing.status, 401);
  EXPECT_NE(missing.body.find("--control-token"), std::string::npos);
  const HttpReply wrong = Send("POST", "/api/simulations/arena/start", Bearer("not-the-right-one"));
  EXPECT_EQ(wrong.status, 403);
  EXPECT_EQ(wrong.body.find("not-the-right-one"), std::string::npos);
  EXPECT_EQ(simulation_->status().phase, simulation::Phase::kCreated);
  EXPECT_EQ(Send("POST", "/api/simulations/arena/start", Bearer(kControl)).status, 200);
  EXPECT_EQ(simulation_->status().phase, simulation::Phase::kRunning);
}

TEST_F(AccessTest, AViewerFromAnotherMachineNeedsATokenToWatch) {
  Start({kControl, kWatch}, "0.0.0.0");
  EXPECT_EQ(Send("GET", "/healthz").status, 200);
  EXPECT_EQ(Send("GET", "/api/simulations").status, 401);
  EXPECT_EQ(Send("GET", "/api/simulations", Bearer(kWatch)).status, 200);
  EXPECT_EQ(Send("GET", "/api/simulations?token=" + std::string(kWatch)).status, 401);
  const HttpReply watcher = Send("POST", "/api/simulations/arena/start", Bearer(kWatch));
  EXPECT_EQ(watcher.status, 403);
  EXPECT_NE(watcher.body.find("does not allow control"), std::string::npos);
  const std::uint16_t port = gateway_->port();
  EXPECT_THROW(Viewer(port, "/ws"), std::runtime_error);
  EXPECT_THROW(Viewer(port, "/ws?token=wrong"), std::runtime_error);
  Viewer looks(port, "/ws?token=" + std::string(kWatch));
  EXPECT_NE(looks.CallRefusedService("start").find("does not allow control"), std::string::npos);
  Viewer acts(port, "/ws?token=" + std::string(kControl));
  EXPECT_TRUE(acts.CallService("start").first);
}

TEST_F(AccessTest, AWatchTokenDoesNotAllowControl) {
  Start({"", kWatch});
  EXPECT_EQ(Send("GET", "/api/simulations").status, 401);
  const HttpReply refused = Send("POST", "/api/simulations/arena/start", Bearer(kWatch));
  EXPECT_EQ(refused.status, 403);
  EXPECT_NE(refused.body.find("allows no control"), std::string::npos);
}

TEST_F(AccessTest, OneViewerHoldsControlAndOthersRequestIt) {
  Start({});
  EXPECT_EQ(Reset(), 200);  // no viewer holds control
  const std::string ada = Enter("Ada <b>"), bob = Enter("Bob");
  const json taken =
      json::parse(Send("POST", "/api/viewers/me/control", As(ada), R"({"wants":true})").body);
  EXPECT_EQ(taken["viewers"][0]["number"], taken["you"]);
  EXPECT_EQ(taken["viewers"][0]["holds_control"], true);
  EXPECT_EQ(Reset(As(ada)), 200);
  for (const std::string& other : {As(bob), std::string(), As("nobody")}) {
    EXPECT_EQ(Reset(other), 409) << other;
  }
  EXPECT_NE(Send("POST", "/api/simulations/arena/reset", As(bob)).body.find("Ada <b> has control"),
            std::string::npos);
  Viewer looks(gateway_->port(), "/ws?viewer=" + bob);
  EXPECT_NE(looks.CallRefusedService("start").find("has control"), std::string::npos);
  Send("POST", "/api/viewers/me/control", As(bob), R"({"wants":true})");
  const json told = json::parse(Send("GET", "/api/viewers", As(ada)).body);
  EXPECT_EQ(told["viewers"][1]["asks"], 1);
  EXPECT_GT(told["viewers"][1]["passes_in_s"], 0);
  EXPECT_EQ(told.dump().find(bob), std::string::npos);  // keys are secret
  EXPECT_EQ(Send("POST", "/api/viewers/me/answer", As(ada), R"({"grants":true})").status, 200);
  EXPECT_EQ(Reset(As(bob)), 200);
  EXPECT_TRUE(looks.CallService("start").first);
  EXPECT_EQ(Send("DELETE", "/api/viewers/me", As(bob)).status, 200);
  EXPECT_EQ(Reset(), 200);
}

TEST_F(AccessTest, TwoViewersHoldControlOfTwoSimulations) {
  directory_->Add(std::make_shared<testing::ScriptedSimulation>("other", 1));
  Start({});
  const std::string ada = Enter("Ada"), bob = Enter("Bob");
  EXPECT_EQ(Send("POST", "/api/viewers/me", As(bob), R"({"simulation":"other"})").status, 200);
  for (const std::string& person : {ada, bob}) {
    Send("POST", "/api/viewers/me/control", As(person), R"({"wants":true})");
  }
  const auto reset = [&](const std::string& person, const std::string& simulation) {
    return Send("POST", "/api/simulations/" + simulation + "/reset", As(person)).status;
  };
  EXPECT_EQ(reset(ada, "arena"), 200);
  EXPECT_EQ(reset(bob, "other"), 200);
  EXPECT_EQ(reset(ada, "other"), 409);
  EXPECT_EQ(reset(bob, "arena"), 409);
  // The address of a WebSocket names a simulation. Commands on this WebSocket apply to that
  // simulation, even if the viewer has selected another one.
  Viewer stranger(gateway_->port(), "/ws?simulation=other&viewer=" + ada);
  EXPECT_NE(stranger.CallRefusedService("start").find("Bob has control"), std::string::npos);
  Viewer holder(gateway_->port(), "/ws?simulation=arena&viewer=" + ada);
  EXPECT_TRUE(holder.CallService("start").first);
}

TEST_F(AccessTest, NewViewerReceivesAtOnceWhetherItHasControl) {
  Start({});
  const std::string ada = Enter("Ada");
  Viewer viewer(gateway_->port(), "/ws?simulation=arena&viewer=" + ada);
  viewer.Subscribe(1, "/gsv/viewers");
  const auto heard = [&] { return viewer.ReceiveData(1).payload; };
  EXPECT_NE(heard().find(R"("holds_control":false)"), std::string::npos);
  Send("POST", "/api/viewers/me/control", As(ada), R"({"wants":true})");
  const std::string told = heard();
  EXPECT_NE(told.find(R"("holds_control":true)"), std::string::npos);
  EXPECT_EQ(told.find(ada), std::string::npos);  // keys are secret
}

TEST_F(AccessTest, InvalidRequestsAboutViewersAreRefused) {
  Start({});
  const std::string ada = Enter("Ada");
  for (const char* body : {"", "[]", "{}", R"({"name":1})", "{"}) {
    EXPECT_EQ(Send("POST", "/api/viewers", "", body).status, 400) << body;
  }
  EXPECT_EQ(Send("POST", "/api/viewers/me/control", As(ada), R"({"wants":1})").status, 400);
  EXPECT_EQ(Send("POST", "/api/viewers/me", As("x"), R"({"name":"y"})").status, 404);
  EXPECT_EQ(Send("POST", "/api/viewers/me", As(ada), R"({"simulation":[]})").status, 400);
  const std::string long_name = json{{"simulation", std::string(2000, 'a')}}.dump();
  EXPECT_EQ(Send("POST", "/api/viewers/me", As(ada), long_name).status, 400);
  EXPECT_EQ(Send("POST", "/api/viewers/2").status, 404);
  EXPECT_EQ(Send("PUT", "/api/viewers").status, 405);
  EXPECT_EQ(Send("POST", "/api/viewers/me/answer", As(ada), R"({"grants":true})").status, 409);
}

TEST_F(AccessTest, ARelaySendsItsTokenForItsViewers) {
  Start({kControl, kWatch});
  EXPECT_FALSE(Gateway::StartRelay({}, {gateway_->url()}));
  const auto relay = Gateway::StartRelay({}, {gateway_->url(), kControl});
  ASSERT_TRUE(relay) << relay.error().Sentence();
  const std::uint16_t port = (*relay)->port();
  EXPECT_EQ(testing::Fetch(port, "GET", "/api/simulations").status, 200);
  Viewer viewer(port, "/ws?simulation=arena");
  EXPECT_TRUE(viewer.CallService("start").first);
  entering_ = Bearer(kControl);
  const std::string ada = Enter("Ada");
  Send("POST", "/api/viewers/me/control", Bearer(kControl) + As(ada), R"({"wants":true})");
  const std::string reset = "/api/simulations/arena/reset";
  EXPECT_EQ(testing::Fetch(port, "POST", reset, "", "{}").status, 409);
  EXPECT_EQ(testing::Fetch(port, "POST", reset, As(ada), "{}").status, 200);
}

}  // namespace
}  // namespace gsv::gateway::access
