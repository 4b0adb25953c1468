#include "gsv/gateway/api/factory_api.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "gsv/gateway/api/api.h"
#include "gsv/gateway/testing/answer.h"
#include "gsv/gateway/testing/fake_factory.h"

namespace gsv::gateway {
namespace {

using testing::FakeFactory;
using testing::ScriptedSimulation;
using FactoryTestJson = nlohmann::json;

class FactoryApiTest : public ::testing::Test {
 protected:
  FactoryTestJson Ask(const std::string& method, const std::string& target, int status,
                      const std::string& body = "") {
    Request request;
    request.method = method;
    request.target = ParseTarget(target).value();
    request.body = body;
    const Response response = testing::Answer(router_, request);
    EXPECT_EQ(response.status, status) << target << " " << response.body.view();
    return FactoryTestJson::parse(response.body.view());
  }

  std::shared_ptr<testing::SimulationList> list_ = std::make_shared<testing::SimulationList>();
  FakeFactory factory_{*list_};
  static base::Result<std::vector<std::uint8_t>> Glb(const model::Model&) {
    return std::vector<std::uint8_t>{1};
  }
  Api api_{list_, &FactoryApiTest::Glb, nullptr, &factory_};
  const Router router_{api_.Routes()};
};

TEST_F(FactoryApiTest, ReturnsTheCapabilitiesOfTheServer) {
  EXPECT_EQ(Ask("GET", "/api/server", 200),
            (FactoryTestJson{{"creates", true}, {"records", false}, {"recordings", false}}));
  Api none(list_, &FactoryApiTest::Glb);
  const Router routes_of_none(none.Routes());
  Request request;
  request.method = "GET";
  request.target = ParseTarget("/api/server").value();
  EXPECT_EQ(testing::Answer(routes_of_none, request).body.view(),
            R"({"creates":false,"records":false,"recordings":false})");
  request.target = ParseTarget("/api/worlds").value();
  EXPECT_EQ(testing::Answer(routes_of_none, request).status, 404);
}

TEST_F(FactoryApiTest, ListsTheAvailableChoices) {
  EXPECT_EQ(Ask("GET", "/api/worlds", 200)["worlds"][1]["name"], "<b>office</b>");
  const auto models = Ask("GET", "/api/models", 200)["models"];
  EXPECT_EQ(models[0], (FactoryTestJson{{"name", "avatar"}, {"is_avatar", true}}));
  EXPECT_EQ(Ask("GET", "/api/models", 200)["objects"][0]["name"], "crate");
  const auto found = Ask("GET", "/api/behaviours?constraint=pid%20%3E%200", 200);
  EXPECT_EQ(found["behaviours"][0]["description"], "pid > 0");
  EXPECT_EQ(found["start_command"], "gsv-wander");
  Ask("GET", "/api/behaviours?constraint=1%20%2B", 400);
  Ask("POST", "/api/worlds", 405);
}

TEST_F(FactoryApiTest, ReturnsWhetherRos2IsAvailable) {
  factory_.ros2 = {false, "built without it", "", ""};
  EXPECT_EQ(
      Ask("GET", "/api/ros2", 200),
      (FactoryTestJson{
          {"available", false}, {"reason", "built without it"}, {"reach", ""}, {"published", ""}}));
}

TEST_F(FactoryApiTest, APreviewHasASceneAndPosesButIsNotListed) {
  const auto preview = Ask("POST", "/api/preview", 200, R"({"world": "w"})");
  EXPECT_EQ(preview["warnings"][0], "no mesh");
  EXPECT_FALSE(preview["scene"]["bodies"].empty());
  EXPECT_EQ(preview["poses"].size(), 7 * preview["scene"]["poses"].size());
  EXPECT_TRUE(Ask("GET", "/api/simulations", 200).empty());
}

TEST_F(FactoryApiTest, CreatesAndDestroys) {
  EXPECT_EQ(Ask("POST", "/api/simulations", 201, R"({"name": "a b", "world": "w"})")["name"],
            "a b");
  EXPECT_EQ(Ask("GET", "/api/simulations", 200).size(), 1u);
  Ask("DELETE", "/api/simulations/a%20b", 200);
  EXPECT_TRUE(Ask("GET", "/api/simulations", 200).empty());
  Ask("DELETE", "/api/simulations/a%20b", 404);
}

TEST_F(FactoryApiTest, ARefusalNamesTheField) {
  const auto malformed = Ask("POST", "/api/simulations", 400, R"({"world": "w", "seed": -1})");
  EXPECT_EQ(malformed["field"], "seed");
  EXPECT_FALSE(malformed["error"].get<std::string>().empty());
  factory_.refusal = FieldError{{base::ErrorCode::kBadModel, "there is no such model", "pebbl"},
                                "robots[0].model"};
  for (const char* address : {"/api/simulations", "/api/preview"}) {
    const auto refused = Ask("POST", address, 422, R"({"world": "w"})");
    EXPECT_EQ(refused["field"], "robots[0].model");
    EXPECT_EQ(refused["error"], "pebbl: there is no such model");
  }
}

TEST_F(FactoryApiTest, AddsRobotsAndPlacesBodies) {
  list_->Add(std::make_shared<ScriptedSimulation>("run", 1));
  const std::string robots = "/api/simulations/run/robots";
  EXPECT_EQ(Ask("POST", robots, 201, R"({"model": "m"})")["name"], "m_robot");
  EXPECT_EQ(Ask("POST", robots, 201, R"({"model": "m", "avatar": true})")["name"], "m_avatar");
  EXPECT_EQ(Ask("POST", robots, 400, "{}")["field"], "model");
  EXPECT_EQ(Ask("POST", robots, 201, R"({"name": "of_the_world", "x": 1, "y": 2})")["name"],
            "_robot");
  EXPECT_EQ(Ask("POST", robots, 400, R"({"name": ""})")["field"], "model");
  EXPECT_EQ(Ask("POST", "/api/simulations/run/bodies/m/place", 400, R"({"x": 1})")["field"], "y");
  Ask("GET", robots, 405);
  Ask("GET", robots + "/m", 405);
  Ask("POST", "/api/simulations/run/bodies/m", 404);
}

TEST_F(FactoryApiTest, AddsObjectsFromAModelOrAsACopy) {
  list_->Add(std::make_shared<ScriptedSimulation>("run", 1));
  const std::string objects = "/api/simulations/run/objects";
  EXPECT_EQ(Ask("POST", objects, 201, R"({"model": "crate"})")["name"], "crate");
  EXPECT_FALSE(factory_.asked.place);
  Ask("POST", objects, 201, R"({"copy_of": "ball", "name": "b", "x": 1, "y": 2, "z": 3,
                                "roll": 1.5707963267948966})");
  EXPECT_EQ(factory_.asked.copy_of, "ball");
  EXPECT_EQ(factory_.asked.name, "b");
  ASSERT_TRUE(factory_.asked.place);
  EXPECT_FALSE(factory_.asked.place->on_ground);
  const geometry::Pose& pose = factory_.asked.place->world_from_body;
  EXPECT_EQ(pose.position, (geometry::Vector3{1, 2, 3}));
  EXPECT_NEAR((pose.orientation * geometry::Vector3{0, 1, 0}).z, 1, 1e-12);
}

TEST_F(FactoryApiTest, AnInvalidObjectNamesItsField) {
  list_->Add(std::make_shared<ScriptedSimulation>("run", 1));
  const std::string objects = "/api/simulations/run/objects";
  const std::pair<const char*, const char*> wrong[]{
      {R"({})", "model"},
      {R"({"model": "a", "copy_of": "b"})", "model"},
      {R"({"model": 7})", "model"},
      {R"({"model": "a", "x": 1})", "y"},
      {R"({"model": "a", "x": "left", "y": 1})", "x"},
      {R"({"model": "a", "x": 1, "y": 1, "roll": "over"})", "roll"},
      {R"({"model": "a", "x": 1, "y": 1, "pitch": 1e300})", "pitch"},
      {R"({"model": "a", "x": 1, "y": 1, "colour": "red"})", "colour"}};
  for (const auto& [body, field] : wrong) {
    const auto refused = Ask("POST", objects, 400, body);
    EXPECT_EQ(refused["field"], field) << body;
    EXPECT_FALSE(refused["error"].get<std::string>().empty());
  }
  Ask("GET", objects, 405);
  Ask("GET", objects + "/crate", 405);
}

}  // namespace
}  // namespace gsv::gateway
