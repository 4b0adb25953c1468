// Compares docs/api.yaml, which every program serves as the description of its API, with the
// routes.
#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <fstream>
#include <map>
#include <ostream>
#include <regex>
#include <set>
#include <sstream>

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include "apps/gsv/lost/lost_page.h"
#include "apps/gsv/serving/broker_page.h"
#include "apps/gsv/serving/instances_page.h"
#include "gsv/base/temporary_folder.h"
#include "gsv/gateway/gateway.h"
#include "gsv/gateway/testing/fake_factory.h"
#include "gsv/gateway/testing/replay_fixture.h"
#include "gsv/gateway/testing/web_client.h"

namespace gsv::app {
namespace {

using gateway::Gateway;
using gateway::GatewayOptions;
using gateway::Permission;
using gateway::Route;

struct Operation {
  std::string summary, permission;
  bool needs_control = false;
  std::set<std::string> parameters;  // the parameters in the path

  friend bool operator==(const Operation&, const Operation&) = default;
  friend std::ostream& operator<<(std::ostream& out, const Operation& operation) {
    out << '"' << operation.summary << "\" " << operation.permission
        << (operation.needs_control ? " needs control" : "") << " {";
    for (const std::string& name : operation.parameters) out << name << " ";
    return out << "}";
  }
};
// The key is "METHOD /path/{parameter}".
using Operations = std::map<std::string, Operation>;

const std::string kFile = std::string(std::getenv("GSV_SOURCE_DIR")) + "/docs/api.yaml";

// Adds the path parameters that a description declares as required.
void AddDeclared(const YAML::Node& file, const YAML::Node& parameters,
                 std::set<std::string>& declared) {
  for (const YAML::Node& each : parameters) {
    const std::string reference = each["$ref"] ? each["$ref"].as<std::string>() : "";
    const YAML::Node parameter =
        reference.empty()
            ? each
            : file["components"]["parameters"][reference.substr(reference.rfind('/') + 1)];
    if (parameter["in"].as<std::string>() != "path") continue;
    EXPECT_TRUE(parameter["required"].as<bool>());
    declared.insert(parameter["name"].as<std::string>());
  }
}

Operations Described() {
  const YAML::Node file = YAML::LoadFile(kFile);
  Operations operations;
  for (const auto& path : file["paths"]) {
    for (const auto& each : path.second) {
      const YAML::Node described = each.second;
      std::string method = each.first.as<std::string>();
      if (method == "parameters") continue;
      std::transform(method.begin(), method.end(), method.begin(), ::toupper);
      Operation operation{described["summary"].as<std::string>(),
                          described["x-permission"].as<std::string>(),
                          described["x-needs-control"].as<bool>(false)};
      AddDeclared(file, path.second["parameters"], operation.parameters);
      AddDeclared(file, described["parameters"], operation.parameters);
      operations[method + " " + path.first.as<std::string>()] = operation;
    }
  }
  return operations;
}

const char* Spelling(Permission permission) {
  return permission == Permission::kNone    ? "none"
         : permission == Permission::kWatch ? "watch"
                                            : "control";
}

// Returns the path in the form of the API description, which has {path} for "{path...}", because a
// parameter in a description is a single segment.
std::string AddressOf(const Route& route) {
  return route.method + " " + std::regex_replace(route.pattern, std::regex(R"(\.\.\.\})"), "}");
}

Operation OperationOf(const Route& route) {
  Operation operation{route.summary, Spelling(route.permission), route.needs_control};
  static const std::regex kParameter(R"(\{(\w+)(\.\.\.)?\})");
  const std::sregex_iterator begin(route.pattern.begin(), route.pattern.end(), kParameter);
  for (auto found = begin; found != std::sregex_iterator(); ++found) {
    operation.parameters.insert((*found)[1]);
  }
  return operation;
}

class NoRecordings final : public gateway::RecordingSwitch {
 public:
  Totals totals() override { return {}; }
  base::Status Record(const std::shared_ptr<simulation::Simulation>&) override { return {}; }
  base::Status StopRecording(const std::string&) override { return {}; }
  State RecordingOf(const std::string&) override { return {}; }
};

// Starts three gateways, because each kind has its own routes: for live simulations, for a replay
// and for a relay. The routes include those that gsv adds, such as the page of the broker.
class OpenApiTest : public ::testing::Test {
 protected:
  void SetUp() override {
    GatewayOptions options;
    options.factory = &factory_;
    options.recordings = &recordings_;
    options.recordings_folder = folder_.path();
    options.history_bytes = 1 << 20;
    options.routes = BrokerRoutes(CORBA::ORB::_nil(), "corbaloc:");
    Append(options.routes, InstancesRoutes(CORBA::ORB::_nil(), "corbaloc:", "here:1"));
    Append(options.routes, LostRoutes(lost_));
    live_ = Gateway::Start(options, directory_).value();

    const std::string file = folder_.path() / "run.mcap";
    gateway::testing::RecordRun(file);
    player_ = gateway::ReplayPlayer::Open(file, {}).value();
    options.only_recording = "run.mcap";
    replay_ = Gateway::StartReplay(options, *player_).value();

    relay_ = Gateway::StartRelay({}, {live_->url()}).value();
  }

  const base::TemporaryFolder folder_ = *base::TemporaryFolder::Make("gsv-openapi");
  const std::shared_ptr<gateway::testing::SimulationList> directory_ =
      std::make_shared<gateway::testing::SimulationList>();
  gateway::testing::FakeFactory factory_{*directory_};
  NoRecordings recordings_;
  services::SimulationHost host_{nullptr, nullptr};
  LostSimulations lost_{{"test", "corbaloc:", folder_.path()}, host_, recordings_};
  std::unique_ptr<gateway::ReplayPlayer> player_;
  std::unique_ptr<Gateway> live_, replay_, relay_;
};

TEST_F(OpenApiTest, DescribesEveryRouteAndNothingElse) {
  const Operations described = Described();
  std::set<std::string> routed;
  for (const auto* set : {&live_, &replay_}) {
    for (const Route& route : (*set)->router().routes()) {
      const std::string address = AddressOf(route);
      if (route.pattern.starts_with("/replays/{session}/api/")) continue;
      EXPECT_TRUE(described.contains(address)) << address << " is a route, and not described";
      if (!described.contains(address)) continue;
      Operation operation = OperationOf(route);
      if (operation.summary == "Always refused, because a replay cannot be changed") {
        operation.summary = described.at(address).summary;
      }
      EXPECT_EQ(operation, described.at(address)) << address;
      routed.insert(address);
    }
  }
  for (const auto& [address, operation] : described) {
    EXPECT_TRUE(routed.contains(address)) << address << " is described, and no route";
  }
}

TEST_F(OpenApiTest, ReplaySessionHasTheRoutesOfAReplayAndNeedsPermissionToView) {
  const std::string below = "/replays/{session}";
  std::set<std::string> own, shared;
  for (const Route& route : live_->router().routes()) {
    if (!route.pattern.starts_with(below + "/api/")) continue;
    EXPECT_EQ(route.permission, Permission::kWatch) << route.pattern;
    EXPECT_FALSE(route.needs_control) << route.pattern;
    own.insert(route.method + " " + route.pattern.substr(below.size()));
  }
  for (const Route& route :
       gateway::ReplayRoutes([](const gateway::Request&) { return gateway::Replay(); })) {
    shared.insert(AddressOf(route));
  }
  EXPECT_EQ(own, shared);
}

TEST_F(OpenApiTest, RelayAppliesTheDescribedPermissions) {
  for (const auto& [address, operation] : Described()) {
    const std::size_t blank = address.find(' ');
    const std::string path =
        std::regex_replace(address.substr(blank + 1), std::regex(R"(\{\w+\})"), "x");
    const auto match =
        relay_->router().Find(address.substr(0, blank), gateway::ParseTarget(path).value());
    ASSERT_NE(match.route, nullptr) << address;
    EXPECT_EQ(Spelling(match.permission), operation.permission) << address;
  }
}

TEST_F(OpenApiTest, IsServedByEveryGateway) {
  std::ostringstream file;
  file << std::ifstream(kFile).rdbuf();
  for (const auto* set : {&live_, &replay_, &relay_}) {
    const auto reply = gateway::testing::Fetch((*set)->port(), "GET", "/api/openapi.yaml");
    EXPECT_EQ(reply.status, 200);
    EXPECT_EQ(reply.headers.at("content-type"), "application/yaml");
    EXPECT_TRUE(reply.body == file.str()) << reply.body.substr(0, 100);
  }
}

}  // namespace
}  // namespace gsv::app
