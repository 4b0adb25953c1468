#include "gsv/gateway/scenario_json.h"

#include <gtest/gtest.h>

namespace gsv::gateway {
namespace {

TEST(ScenarioJson, AWorldAloneIsEnough) {
  const auto request = ParseSimulationRequest(R"({"world": "office"})");
  ASSERT_TRUE(request) << request.error().error.message;
  EXPECT_EQ(request->world, "office");
  EXPECT_EQ(request->mode, simulation::Mode::kRealTime);
  EXPECT_EQ(request->factor, 1);
  EXPECT_TRUE(request->robots.empty());
}

TEST(ScenarioJson, EveryKeyIsTaken) {
  const auto request = ParseSimulationRequest(R"({
    "name": "run", "world": "maze", "mode": "lockstep", "factor": 2.5, "step": 0.01,
    "duration": 60, "seed": 18446744073709551615, "record": true,
    "robots": [{"name": "a", "model": "pebble", "x": 1, "y": -2, "z": 0.5, "yaw": 3,
                "behaviour": "goto --goal-x 3", "movement": "rigid"},
               {"model": "rover4", "behaviour_constraint": "pid > 0", "movement": "planar"}],
    "avatars": [{"model": "avatar", "x": 0, "y": 1}]})");
  ASSERT_TRUE(request) << request.error().field << request.error().error.message;
  EXPECT_EQ(request->name, "run");
  EXPECT_EQ(request->mode, simulation::Mode::kLockstep);
  EXPECT_EQ(request->factor, 2.5);
  EXPECT_EQ(request->step, 0.01);
  EXPECT_EQ(request->duration, 60);
  EXPECT_EQ(request->seed, 18446744073709551615u);
  EXPECT_TRUE(request->record);
  ASSERT_EQ(request->robots.size(), 2u);
  const RobotRequest& first = request->robots[0];
  ASSERT_TRUE(first.place);
  EXPECT_EQ(first.place->x, 1);
  EXPECT_EQ(first.place->y, -2);
  EXPECT_EQ(first.place->z, 0.5);
  EXPECT_EQ(first.place->yaw, 3);
  EXPECT_EQ(first.behaviour, "goto --goal-x 3");
  EXPECT_EQ(first.movement, model::Movement::kRigid);
  EXPECT_FALSE(request->robots[1].place);
  EXPECT_EQ(request->robots[1].behaviour_constraint, "pid > 0");
  EXPECT_EQ(request->robots[1].movement, model::Movement::kPlanar);
  ASSERT_EQ(request->avatars.size(), 1u);
  EXPECT_FALSE(request->avatars[0].place->z);
}

struct Refused {
  const char* body;
  const char* field;
};

TEST(ScenarioJson, WhatIsWrongIsRefusedWithItsField) {
  const Refused refused[]{
      {R"({})", "world"},
      {R"({"world": 3})", "world"},
      {R"({"world": "w", "wolrd": 1})", "wolrd"},
      {R"({"world": "w", "mode": "fast"})", "mode"},
      {R"({"world": "w", "factor": 0})", "factor"},
      {R"({"world": "w", "factor": "1"})", "factor"},
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

TEST(ScenarioJson, MoreRobotsThanAnybodyTypesAreRefused) {
  std::string body = R"({"world": "w", "robots": [{"model": "m"})";
  for (int i = 0; i < 1000; ++i) body += R"(,{"model": "m"})";
  const auto request = ParseSimulationRequest(body + "]}");
  ASSERT_FALSE(request);
  EXPECT_EQ(request.error().field, "robots");
}

TEST(ScenarioJson, ARobotIsAddedWithOrWithoutAPlace) {
  const auto robot = ParseRobotRequest(R"({"model": "avatar", "avatar": true})");
  ASSERT_TRUE(robot);
  EXPECT_TRUE(robot->is_avatar);
  EXPECT_FALSE(robot->place);
  EXPECT_EQ(ParseRobotRequest(R"({"model": ""})").error().field, "model");
}

TEST(ScenarioJson, APlaceNeedsBothCoordinates) {
  const auto place = ParsePlace(R"({"x": 1, "y": 2})");
  ASSERT_TRUE(place);
  EXPECT_EQ(place->yaw, 0);
  EXPECT_EQ(ParsePlace(R"({"x": 1})").error().field, "y");
  EXPECT_EQ(ParsePlace(R"({"y": 1, "x": "far"})").error().field, "x");
}

}  // namespace
}  // namespace gsv::gateway
