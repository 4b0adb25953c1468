#include "gsv/gateway/api/api.h"

#include <algorithm>
#include <set>
#include <thread>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "gsv/gateway/testing/answer.h"
#include "gsv/gateway/testing/scripted_simulation.h"
#include "gsv/gateway/testing/simulation_list.h"
#include "gsv/presentation/scene_json.h"

namespace gsv::gateway {
namespace {

using nlohmann::json;
using testing::ScriptedSimulation;

class ApiTest : public ::testing::Test {
 protected:
  void SetUp() override { directory_->Add(simulation_); }

  Response Ask(const std::string& method, const std::string& target, const std::string& body = "") {
    Request request;
    request.method = method;
    request.target = ParseTarget(target).value();
    request.body = body;
    return testing::Answer(router_, request);
  }

  json AskJson(const std::string& method, const std::string& target, int status,
               const std::string& body = "") {
    const Response response = Ask(method, target, body);
    EXPECT_EQ(response.status, status) << target << " " << response.body.view();
    EXPECT_EQ(response.content_type, "application/json");
    EXPECT_EQ(response.cache_control, "no-store");
    return json::parse(response.body.view());
  }

  std::shared_ptr<ScriptedSimulation> simulation_ =
      std::make_shared<ScriptedSimulation>("first light", 2);
  std::shared_ptr<testing::SimulationList> directory_ = std::make_shared<testing::SimulationList>();
  Api api_{directory_, [](const model::Model& model) -> base::Result<std::vector<std::uint8_t>> {
             return std::vector<std::uint8_t>(model.name.begin(), model.name.end());
           }};
  const Router router_{api_.Routes()};
  const std::string path_ = "/api/simulations/first%20light";
};

// A fake RecordingSwitch that stores the commands to it.
class FakeRecordings final : public RecordingSwitch {
 public:
  Totals totals() override { return {}; }
  base::Status Record(const std::shared_ptr<simulation::Simulation>& simulation) override {
    if (state.is_recording) return base::Fail(base::ErrorCode::kInvalidArgument, "it is recorded");
    state = {true, simulation->specification().name + ".mcap", 5, 1, 99};
    return {};
  }
  base::Status StopRecording(const std::string&) override {
    if (!state.is_recording)
      return base::Fail(base::ErrorCode::kNotFound, "it is not being recorded");
    state.is_recording = false;
    return {};
  }
  State RecordingOf(const std::string&) override { return state; }

  State state;
};

TEST_F(ApiTest, SwitchesTheRecordingOnAndOff) {
  FakeRecordings recordings;
  Api api(directory_, nullptr, &recordings);
  const Router router(api.Routes());
  const auto ask = [&](const std::string& method, const std::string& body = "") {
    Request request;
    request.method = method;
    request.target = ParseTarget(path_ + "/recording").value();
    request.body = body;
    return testing::Answer(router, request);
  };
  EXPECT_EQ(json::parse(ask("GET").body.view())["recording"], false);
  EXPECT_EQ(json::parse(ask("POST", R"({"record":true})").body.view()),
            json::parse(R"({"recording":true,"path":"first light.mcap","messages":5,
                            "dropped_messages":1,"size_bytes":99})"));
  EXPECT_EQ(ask("POST", R"({"record":true})").status, 400);
  EXPECT_EQ(json::parse(ask("POST", R"({"record":false})").body.view())["recording"], false);
  EXPECT_EQ(ask("POST", R"({"record":false})").status, 404);
  for (const char* bad : {"", "[]", R"({"record":1})", R"({"path":"/etc/passwd"})"}) {
    EXPECT_EQ(ask("POST", bad).status, 400) << bad;
  }
  EXPECT_EQ(ask("PUT").status, 405);
  EXPECT_EQ(AskJson("GET", path_ + "/recording", 404)["error"],
            "this server cannot record simulations");
}

TEST_F(ApiTest, ReturnsTheTopicsOfARobotAndAdvertisesThem) {
  std::vector<std::string> listed;
  Api api(directory_, nullptr, nullptr, nullptr, false,
          [&](const auto& simulation, const std::string& robot) {
            EXPECT_EQ(simulation, simulation_);
            listed.push_back(robot);
          });
  const Router router(api.Routes());
  const auto ask = [&](const std::string& method, const std::string& robot) {
    Request request;
    request.method = method;
    request.target = ParseTarget(path_ + "/robots/" + robot + "/topics").value();
    return testing::Answer(router, request);
  };
  const json topics = json::parse(ask("GET", "robot_0").body.view())["topics"];
  const std::set<std::string> names(topics.begin(), topics.end());
  EXPECT_TRUE(names.contains("/robot_0/front_sonar"));
  EXPECT_TRUE(names.contains("/robot_0/camera"));
  EXPECT_TRUE(names.contains("/robot_0/camera/camera_info"));
  EXPECT_EQ(ask("GET", "nobody").status, 404);
  EXPECT_EQ(ask("POST", "robot_0").status, 405);
  EXPECT_EQ(listed, std::vector<std::string>{"robot_0"});
}

TEST_F(ApiTest, ListsTheSimulations) {
  const json list = AskJson("GET", "/api/simulations", 200);
  ASSERT_EQ(list.size(), 1u);
  EXPECT_EQ(list[0], json::parse(R"({"name":"first light","phase":"created","mode":"real_time",
                                     "time_s":0,"real_time_factor":0,"robots":3})"));
}

TEST_F(ApiTest, ReturnsTheStatus) {
  simulation_->Advance(std::chrono::seconds(5));
  const json status = AskJson("GET", path_, 200);
  EXPECT_EQ(status["step"], 500);
  EXPECT_EQ(status["time_s"], 5);
  EXPECT_EQ(status["step_size_s"], 0.01);
  ASSERT_EQ(status["robots"].size(), 3u);
  EXPECT_EQ(status["robots"][0]["is_avatar"], true);
  const json& robot = status["robots"][1];
  EXPECT_EQ(robot["name"], "robot_0");
  EXPECT_EQ(robot["behaviour"], "circle");
  EXPECT_NEAR(robot["pose"]["x_m"].get<double>(), std::cos(1.0), 1e-12);
  EXPECT_NEAR(robot["pose"]["yaw_rad"].get<double>(), 1 + std::acos(0.0), 1e-12);
  EXPECT_NEAR(robot["distance_m"].get<double>(), 1, 1e-12);
}

TEST_F(ApiTest, PauseStepResumeAndResetWork) {
  EXPECT_EQ(AskJson("POST", path_ + "/start", 200, "{}")["phase"], "running");
  EXPECT_EQ(AskJson("POST", path_ + "/pause", 200, "{}")["phase"], "paused");
  EXPECT_EQ(AskJson("POST", path_ + "/step", 200, R"({"count":3})")["step"], 3);
  EXPECT_EQ(AskJson("POST", path_ + "/step", 200)["step"], 4);
  EXPECT_EQ(AskJson("POST", path_ + "/resume", 200)["phase"], "running");
  EXPECT_EQ(AskJson("POST", path_ + "/stop", 200)["phase"], "stopped");
  EXPECT_EQ(AskJson("POST", path_ + "/reset", 200)["step"], 0);
}

TEST_F(ApiTest, SetsTheRealTimeFactor) {
  const std::string path = path_ + "/real_time_factor";
  EXPECT_EQ(AskJson("POST", path, 200, R"({"real_time_factor":2.5})")["target_factor"], 2.5);
  EXPECT_EQ(simulation_->real_time_factor(), 2.5);
  for (const char* body : {"", "{}", "[]", R"({"real_time_factor":"2"})",
                           R"({"real_time_factor":null})", R"({"real_time_factor":0})",
                           R"({"real_time_factor":-1})", R"({"real_time_factor":1,"factor":1})"}) {
    EXPECT_FALSE(AskJson("POST", path, 400, body)["error"].empty()) << body;
  }
  EXPECT_EQ(simulation_->real_time_factor(), 2.5);
  EXPECT_EQ(Ask("GET", path).allow, "POST");
  // The deprecated route /factor, with its parameter `factor`, still works.
  EXPECT_EQ(AskJson("POST", path_ + "/factor", 200, R"({"factor":0.5})")["target_factor"], 0.5);
}

TEST_F(ApiTest, CommandsAreDescribedAndTakeTheirArguments) {
  const auto commands = AskJson("GET", path_ + "/commands", 200);
  const auto gravity = std::find_if(commands.begin(), commands.end(), [](const auto& command) {
    return command["name"] == "set_gravity";
  });
  ASSERT_NE(gravity, commands.end());
  const auto& z = (*gravity)["parameters"][0];
  EXPECT_EQ(z["name"], "z");
  EXPECT_EQ(z["type"], "number");
  EXPECT_EQ(z["unit"], "m/s²");
  EXPECT_EQ(z["required"], false);
  EXPECT_EQ(z["minimum"], -100);
  EXPECT_EQ(z["maximum"], 100);
  EXPECT_EQ(z["default_meaning"], "the world's own");
  AskJson("POST", path_ + "/set_gravity", 200, R"({"z":-1.62})");
  EXPECT_EQ(simulation_->gravity(), -1.62);
  EXPECT_EQ(AskJson("POST", path_ + "/set_gravity", 400, R"({"z":-101})")["error"],
            "set_gravity: 'z' must be a number from -100 to 100 m/s², and it is -101");
  EXPECT_EQ(AskJson("POST", path_ + "/set_gravity", 400, R"({"x":1})")["error"],
            "set_gravity: there is no parameter 'x'; known: z");
  AskJson("POST", path_ + "/set_gravity", 200);
  EXPECT_EQ(simulation_->gravity(), std::nullopt);
}

TEST_F(ApiTest, ARequestThatThePhaseDoesNotAllowGetsStatus409) {
  EXPECT_EQ(AskJson("POST", path_ + "/resume", 409)["error"],
            "the simulation is created and cannot be resumed");
}

TEST_F(ApiTest, RefusesBadCommands) {
  for (const char* body : {"[]", "{", R"({"count":0})", R"({"count":-1})", R"({"count":1.5})",
                           R"({"count":"3"})", R"({"count":1000000001})"}) {
    EXPECT_FALSE(AskJson("POST", path_ + "/step", 400, body)["error"].empty()) << body;
  }
  for (const char* body : {"1", R"({"linear_m_s":"fast"})", R"({"angular_rad_s":null})",
                           R"({"timeout_s":0})", R"({"timeout_s":61})", R"({"timeout_s":"1"})"}) {
    EXPECT_FALSE(AskJson("POST", path_ + "/robots/avatar/drive", 400, body)["error"].empty());
  }
}

TEST_F(ApiTest, DrivesAnAvatar) {
  AskJson("POST", path_ + "/robots/avatar/drive", 200,
          R"({"linear_m_s":0.5,"lateral_m_s":-0.25,"angular_rad_s":1})");
  EXPECT_EQ(simulation_->avatar_command(), (world::DriveCommand{0.5, -0.25, 1}));
  AskJson("POST", path_ + "/robots/avatar/drive", 200, R"({"angular_rad_s":2})");
  EXPECT_EQ(simulation_->avatar_command(), (world::DriveCommand{0, 0, 2}));
}

TEST_F(ApiTest, AnAvatarStopsWhenNoFurtherCommandComes) {
  AskJson("POST", path_ + "/robots/avatar/drive", 200, R"({"linear_m_s":0.5,"timeout_s":0.01})");
  while (simulation_->avatar_command() != world::DriveCommand{}) std::this_thread::yield();
  // A command applies until its timeout, or until the next command.
  AskJson("POST", path_ + "/robots/avatar/drive", 200, R"({"linear_m_s":1,"timeout_s":60})");
  AskJson("POST", path_ + "/robots/avatar/drive", 200, R"({"linear_m_s":0.5})");
  EXPECT_EQ(simulation_->avatar_command(), (world::DriveCommand{0.5, 0, 0}));
}

TEST_F(ApiTest, RefusesToDriveARobotWithABehaviour) {
  EXPECT_EQ(AskJson("POST", path_ + "/robots/robot_0/drive", 409, "{}")["error"],
            "'robot_0' is controlled by its behaviour 'circle'. Add a robot without a behaviour to "
            "control it yourself.");
  AskJson("POST", path_ + "/robots/nobody/drive", 404, "{}");
}

TEST_F(ApiTest, ListsTheJointsOfABodyWithTheirState) {
  simulation_->Advance(std::chrono::seconds(2));
  const json listed = AskJson("GET", path_ + "/bodies/robot_0/joints", 200);
  EXPECT_EQ(listed["body"], "robot_0");
  EXPECT_EQ(listed["time_s"], 2);
  EXPECT_EQ(listed["refusal"],
            "'robot_0' is controlled by its behaviour 'circle'. Add a robot without a behaviour to "
            "control it yourself.");
  ASSERT_EQ(listed["joints"].size(), 2u);
  const json wheel = listed["joints"][0];
  EXPECT_EQ(wheel["kind"], "continuous");
  EXPECT_EQ(wheel["unit"], "rad");
  EXPECT_DOUBLE_EQ(wheel["position"], 2);  // wheels turn at 1 rad/s
  EXPECT_FALSE(wheel.contains("minimum"));
  EXPECT_EQ(wheel["refusal"], "the robot's drive controls this joint");
  EXPECT_EQ(AskJson("GET", path_ + "/bodies/crate_0/joints", 200)["joints"], json::array());
  AskJson("GET", path_ + "/bodies/nobody/joints", 404);
}

TEST_F(ApiTest, CommandsAJoint) {
  const std::string name =
      AskJson("GET", path_ + "/bodies/avatar/joints", 200)["joints"][1]["name"];
  AskJson("POST", path_ + "/bodies/avatar/joints/" + name, 200, R"({"position":0.5})");
  const world::JointCommand turned{world::JointCommand::Kind::kPosition, 0.5};
  EXPECT_EQ(simulation_->joint_command(), std::pair(1, turned));
  AskJson("POST", path_ + "/bodies/avatar/joints/elbow", 404, R"({"position":0.5})");
  AskJson("POST", path_ + "/bodies/nobody/joints/" + name, 404, R"({"position":0.5})");
  AskJson("POST", path_ + "/bodies/robot_0/joints/" + name, 409, R"({"position":0.5})");
  for (const char* bad :
       {"", "{}", R"({"position":"far"})", R"({"angle":1})", R"({"position":1,"velocity":2})"}) {
    EXPECT_EQ(AskJson("POST", path_ + "/bodies/avatar/joints/" + name, 400, bad)["error"],
              "the body of the request must be {\"position\": v}, {\"velocity\": v} or "
              "{\"effort\": v}")
        << bad;
  }
}

TEST_F(ApiTest, UnknownAddressesAndMethodsAreRefused) {
  for (const char* target :
       {"/api", "/api/robots", "/api/simulations/other", "/api/simulations/first%20light/fly",
        "/api/simulations/first%20light/robots/avatar/fly",
        "/api/simulations/first%20light/robots/avatar/drive/x", "/api/models", "/api/models/0123",
        "/api/models/0123.glb"}) {
    EXPECT_TRUE(AskJson("GET", target, 404).contains("error")) << target;
  }
  EXPECT_EQ(Ask("POST", "/api/simulations").allow, "GET");
  EXPECT_EQ(Ask("DELETE", path_).status, 405);
  EXPECT_EQ(Ask("GET", path_ + "/start").allow, "POST");
  EXPECT_EQ(Ask("POST", path_ + "/scene").allow, "GET");
  EXPECT_EQ(Ask("GET", path_ + "/robots/avatar").allow, "DELETE");
}

TEST_F(ApiTest, TheSceneDescribesAllBodies) {
  const json scene = AskJson("GET", path_ + "/scene", 200);
  EXPECT_EQ(scene["layout_version"], 1);
  EXPECT_EQ(scene["name"], "arena");
  ASSERT_EQ(scene["bodies"].size(), 8u);  // the bodies are an avatar, 4 crates, a floor and 2
                                          // robots
  const json& crate = scene["bodies"][1];
  EXPECT_EQ(crate["name"], "crate_0");
  EXPECT_EQ(crate["is_static"], true);
  EXPECT_EQ(crate["pose"], json::parse("[-4,-4,0,0,0,0,1]"));
  EXPECT_EQ(crate["sensors"].size(), 0u);
  const json& robot = scene["bodies"][6];
  EXPECT_EQ(robot["links"], json::parse(R"(["base","left_wheel","right_wheel"])"));
  EXPECT_EQ(robot["sensors"][0],
            json::parse(R"({"name":"front_sonar","type":"sonar","overlay":"lines","link":"base",
                            "pose":[0.25,0,0.2,0,0,0,1],"topic":"/robot_0/front_sonar","parameters":0,"units":{"range":"m"}})"));
  // Parameters that several sensors share are stored once.
  EXPECT_EQ(scene["sensor_parameters"], json::parse("[{}]"));
  EXPECT_EQ(robot["sensors"][3]["overlay"], "picture");
  EXPECT_EQ(scene["poses"].size(), 9u);
  EXPECT_EQ(scene["poses"][3], json::parse(R"({"body":6,"link":null})"));
  EXPECT_EQ(scene["poses"][4], json::parse(R"({"body":6,"link":"left_wheel"})"));
  EXPECT_EQ(scene["lights"][0]["kind"], "directional");
}

TEST_F(ApiTest, TheSceneHasTheMassesOfMovingBodies) {
  const json scene = AskJson("GET", path_ + "/scene", 200);
  EXPECT_FALSE(
      scene["inertials"].contains(std::string(scene["bodies"][1]["model"])));  // a static crate
  const json& links = scene["inertials"][std::string(scene["bodies"][6]["model"])];
  ASSERT_EQ(links.size(), 3u);
  EXPECT_EQ(links[1]["link"], "left_wheel");
  EXPECT_EQ(links[1]["mass_kg"], 1);
  EXPECT_EQ(links[1]["pose"], json::parse("[0,0,0,0,0,0,1]"));
  EXPECT_EQ(links[1]["inertia_kg_m2"], json::parse("[1,1,1,0,0,0]"));
}

TEST_F(ApiTest, TheBoundsOfTheSceneExcludeTheFloor) {
  const geometry::Bounds bounds = presentation::SceneBounds(*simulation_->snapshot());
  EXPECT_NEAR(bounds.min.x, -4.5, 1e-12);
  EXPECT_NEAR(bounds.max.y, 4.5, 1e-12);
  EXPECT_NEAR(bounds.max.z, 1, 1e-12);
  EXPECT_NEAR(bounds.min.z, 0, 1e-12);
}

TEST_F(ApiTest, ReturnsModelsByTheirIdentifiersInTheScene) {
  const json scene = AskJson("GET", path_ + "/scene", 200);
  const std::string id = scene["bodies"][1]["model"];
  EXPECT_EQ(scene["bodies"][2]["model"], id);
  const Response glb = Ask("GET", "/api/models/" + id + ".glb");
  EXPECT_EQ(glb.status, 200);
  EXPECT_EQ(glb.content_type, "model/gltf-binary");
  EXPECT_EQ(glb.body.view(), "crate");
  EXPECT_EQ(glb.cache_control, "public, max-age=31536000, immutable");
  Request again;
  again.method = "GET";
  again.target = ParseTarget("/api/models/" + id + ".glb").value();
  again.if_none_match = glb.etag;
  EXPECT_EQ(testing::Answer(router_, again).status, 304);
}

}  // namespace
}  // namespace gsv::gateway
