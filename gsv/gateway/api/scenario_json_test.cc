#include "gsv/gateway/api/scenario_json.h"

#include <cmath>

#include <gtest/gtest.h>

namespace gsv::gateway {
namespace {

TEST(ScenarioJson, AWorldAloneIsEnough) {
  const auto request = ParseSimulationRequest(R"({"world": "office"})");
  ASSERT_TRUE(request) << request.error().error.message;
  EXPECT_EQ(request->scenario.world, "office");
  EXPECT_EQ(request->scenario.lockstep, std::nullopt);
  EXPECT_EQ(request->scenario.factor, std::nullopt);
  EXPECT_TRUE(request->scenario.robots.empty());
  EXPECT_FALSE(request->record);
}

TEST(ScenarioJson, EveryKeyIsRead) {
  const auto request = ParseSimulationRequest(R"({
    "name": "run", "world": "maze", "mode": "lockstep", "real_time_factor": 2.5, "step": 0.01,
    "duration": 60, "seed": 18446744073709551615, "record": true,
    "robots": [{"name": "a\u00e4\ud83d\ude00/\"b\u0001", "model": "pebble", "x": 1, "y": -2, "z": 0.5,
                "yaw": 3, "behaviour": "goto --goal-x 3", "movement": "rigid"},
               {"model": "rover4", "behaviour_constraint": "pid > 0", "movement": "planar"}],
    "avatars": [{"model": "avatar", "x": 0, "y": 1}],
    "pedestrians": [{"name": "visitor", "count": 3, "route": [{"x": 1, "y": 2, "radius": 0.5}]}]})");
  ASSERT_TRUE(request) << request.error().field << request.error().error.message;
  const scenario::Scenario& scenario = request->scenario;
  EXPECT_EQ(scenario.name, "run");
  EXPECT_EQ(scenario.lockstep, true);
  EXPECT_EQ(scenario.factor, 2.5);
  EXPECT_EQ(scenario.step, 0.01);
  EXPECT_EQ(scenario.duration, 60);
  EXPECT_EQ(scenario.seed, 18446744073709551615u);
  EXPECT_TRUE(request->record);
  ASSERT_EQ(scenario.robots.size(), 2u);
  const scenario::RobotEntry& first = scenario.robots[0];
  EXPECT_EQ(first.name, "a\u00e4\U0001f600/\"b\x01");
  EXPECT_EQ(first.start, (scenario::Place{1, -2, 0.5, 3}));
  EXPECT_EQ(first.behaviour, "goto --goal-x 3");
  EXPECT_EQ(first.movement, model::Movement::kRigid);
  EXPECT_FALSE(scenario.robots[1].start);
  EXPECT_EQ(scenario.robots[1].behaviour_constraint, "pid > 0");
  EXPECT_EQ(scenario.robots[1].movement, model::Movement::kPlanar);
  ASSERT_EQ(scenario.avatars.size(), 1u);
  EXPECT_FALSE(scenario.avatars[0].start->z);
  ASSERT_EQ(scenario.pedestrians.size(), 1u);
  EXPECT_EQ(scenario.pedestrians[0].count, 3);
  EXPECT_EQ(scenario.pedestrians[0].route, (std::vector<model::PedestrianGoal>{{1, 2, 0.5}}));
}

struct Refused {
  const char* body;
  const char* field;
};

TEST(ScenarioJson, AnErrorIsRefusedWithItsField) {
  const Refused refused[]{
      {R"({})", "world"},
      {R"({"world": ["w"]})", "world"},
      {R"({"world": "w", "model_path": ["/"]})", "model_path"},
      {R"({"world": "w", "in_process": true})", "in_process"},
      {R"({"world": "w", "wolrd": 1})", "wolrd"},
      {R"({"world": "w", "mode": "fast"})", "mode"},
      {R"({"world": "w", "real_time_factor": 0})", "real_time_factor"},
      {R"({"world": "w", "real_time_factor": "1"})", "real_time_factor"},
      {R"({"world": "w", "step": 1e-9})", "step"},
      {R"({"world": "w", "duration": -1})", "duration"},
      {R"({"world": "w", "seed": -1})", "seed"},
      {R"({"world": "w", "seed": 1.5})", "seed"},
      {R"({"world": "w", "record": "run.mcap"})", "record"},
      {R"({"world": "w", "robots": {}})", "robots"},
      {R"({"world": "w", "robots": [1]})", "robots[0]"},
      {R"({"world": "w", "robots": [{"model": "m"}, {}]})", "robots[1].model"},
      {R"({"world": "w", "robots": [{"model": "m", "x": 1}]})", "robots[0].y"},
      {R"({"world": "w", "robots": [{"model": "m", "x": 1e9, "y": 0}]})", "robots[0].x"},
      {R"({"world": "w", "robots": [{"model": "m", "wings": 2}]})", "robots[0].wings"},
      {R"({"world": "w", "robots": [{"model": "m", "movement": "fly"}]})", "robots[0].movement"},
      {R"({"world": "w", "robots": [{"model": "m", "behaviour": "a",
                                     "behaviour_constraint": "b"}]})",
       "robots[0].behaviour_constraint"},
      {R"({"world": "w", "avatars": [{"model": "m", "behaviour": "a"}]})", "avatars[0].behaviour"},
      {R"({"world": "w", "robots": [{"name": "of the world"}]})", "robots[0].model"},
      {R"([])", ""},
      {R"({"world": )", ""},
      {"", ""},
  };
  for (const auto& [body, field] : refused) {
    const auto request = ParseSimulationRequest(body);
    ASSERT_FALSE(request) << body;
    EXPECT_EQ(request.error().field, field) << body;
    EXPECT_EQ(request.error().error.code, base::ErrorCode::kInvalidArgument);
    EXPECT_FALSE(request.error().error.message.empty());
  }
}

TEST(ScenarioJson, AnUnknownFieldIsRefusedWithAListOfKnownFields) {
  const auto request = ParseSimulationRequest(R"({"world": "w", "wolrd": 1})");
  ASSERT_FALSE(request);
  EXPECT_EQ(request.error().error.message,
            "unknown field; the known fields are: name, world, mode, real_time_factor, step, "
            "duration, seed, "
            "robots, avatars, pedestrians, ros2, record");
}

TEST(ScenarioJson, Ros2IsAFlagOrSettings) {
  const auto on = ParseSimulationRequest(R"({"world": "w", "ros2": true})");
  ASSERT_TRUE(on);
  EXPECT_EQ(on->scenario.ros2, scenario::Ros2Settings());
  const auto request =
      ParseSimulationRequest(R"({"world": "w", "ros2": {"namespaces": {"pebble": "fleet"}}})");
  ASSERT_FALSE(request);
  EXPECT_EQ(request.error().field, "ros2.namespaces.pebble");
}

TEST(ScenarioJson, TooManyRobotsAreRefused) {
  std::string body = R"({"world": "w", "robots": [{"model": "m"})";
  for (int i = 1; i < 1000; ++i) body += R"(,{"model": "m"})";
  const auto most = ParseSimulationRequest(body + "]}");
  ASSERT_TRUE(most);
  EXPECT_EQ(most->scenario.robots.size(), 1000u);
  const auto request = ParseSimulationRequest(body + R"(,{"model": "m"}]})");
  ASSERT_FALSE(request);
  EXPECT_EQ(request.error().field, "robots");
}

TEST(ScenarioJson, ARobotMayHaveAPoseOrNone) {
  const auto robot = ParseRobotRequest(R"({"model": "avatar", "avatar": true})");
  ASSERT_TRUE(robot);
  EXPECT_TRUE(robot->is_avatar);
  EXPECT_FALSE(robot->robot.start);
  EXPECT_EQ(ParseRobotRequest(R"({"model": ""})").error().field, "model");
}

// The components x and y of the orientation must be +0 and not -0, because the hash of a state
// depends on the signs of zeros.
TEST(ScenarioJson, ClockwisePosesHaveTheBitsOfPosesInWorldFiles) {
  const auto place = ParsePlace(R"({"x": 1, "y": 2, "yaw": -0.3})");
  ASSERT_TRUE(place.has_value());
  const geometry::Quaternion& q = place->world_from_body.orientation;
  EXPECT_FALSE(std::signbit(q.x) || std::signbit(q.y));
  EXPECT_EQ(q, geometry::FromRollPitchYaw({0, 0, -0.3}));
}

TEST(ScenarioJson, APoseNeedsXAndY) {
  const auto place = ParsePlace(R"({"x": 1, "y": 2})");
  ASSERT_TRUE(place);
  EXPECT_TRUE(place->on_ground);
  EXPECT_EQ(place->world_from_body.position, (geometry::Vector3{1, 2, 0}));
  EXPECT_EQ(place->world_from_body.orientation, geometry::Quaternion{});
  EXPECT_EQ(ParsePlace(R"({})").error().field, "x");
  EXPECT_EQ(ParsePlace(R"({"x": 1})").error().field, "y");
  EXPECT_EQ(ParsePlace(R"({"y": 1, "x": "far"})").error().field, "x");
}

}  // namespace
}  // namespace gsv::gateway
