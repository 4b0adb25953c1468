#include "gsv/view/drawn_scene.h"

#include <cmath>

#include <gtest/gtest.h>

#include "gsv/rendering/renderer.h"

namespace gsv::view {
namespace {

using geometry::Vector3;

// A cube of 1 m in one colour. Its link "arm" is a red cube of 0.2 m at (0, 0, 2).
std::shared_ptr<const model::Model> Cube() {
  auto cube = std::make_shared<model::Model>();
  cube->name = "cube";
  cube->links.resize(2);
  cube->links[0].name = "base";
  cube->links[0].visuals.resize(1);
  cube->links[0].visuals[0].shape = geometry::Box{{1, 1, 1}};
  cube->links[0].visuals[0].materials[0].base_colour = {0, 1, 0, 1};
  cube->links[1].name = "arm";
  cube->links[1].model_from_link.position = {0, 0, 2};
  cube->links[1].visuals.resize(1);
  cube->links[1].visuals[0].shape = geometry::Box{{0.2, 0.2, 0.2}};
  return cube;
}

constexpr const char* kScene = R"({"layout_version": 3, "name": "room",
  "look": {"ambient": [1, 1, 1], "background": [0, 0, 1], "shadows": false, "sky": false},
  "lights": [{"name": "sun", "kind": "directional", "pose": [0,0,5,0,0,0,1],
              "direction": [0,0,-2], "colour": [1,0.5,0], "attenuation": [0.5,0.25,0.125],
              "cast_shadows": false}],
  "bodies": [{"name": "wall", "model": "cube", "is_static": true, "pose": [5,0,0.5,0,0,0,1]},
             {"name": "robot", "model": "cube", "pose": [1,2,3,0,0,0,1],
              "sensors": [{"name": "eye", "link": "arm", "pose": [0.1,0,0,0,0,0,1],
                           "horizontal_fov_rad": 1.5},
                          {"name": "sonar", "link": "base", "pose": [0,0,0,0,0,0,1]}]},
             {"name": "ghost", "model": "unknown", "pose": [0,0,0,0,0,0,1]}],
  "poses": [{"body": 1, "link": null}, {"body": 1, "link": "arm"}, {"body": 2, "link": null}]})";

DrawnScene Room() {
  auto scene = DrawnScene::Make(
      kScene, [](const std::string& id) { return id == "cube" ? Cube() : nullptr; });
  EXPECT_TRUE(scene);
  return *std::move(scene);
}

messages::gsv_msgs::Poses Moved() {
  messages::gsv_msgs::Poses poses;
  poses.layout_version = 3;
  poses.poses = {7, 8, 9, 0, 0, 0, 1, 7, 8, 12, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 1};
  return poses;
}

TEST(DrawnScene, PosesBodiesAndTheirMovingLinks) {
  const DrawnScene room = Room();
  const auto snapshot = room.At(Moved());
  EXPECT_EQ(snapshot->layout->bodies.size(),
            3u);  // The bodies are the wall, the robot and the robot's arm; the ghost has no model.
  const auto lookup = room.LookupAt(*snapshot);
  EXPECT_EQ(lookup.pose("wall")->position, (Vector3{5, 0, 0.5}));
  EXPECT_EQ(lookup.pose("robot")->position, (Vector3{7, 8, 9}));
  EXPECT_FALSE(lookup.pose("ghost"));
  // The camera is mounted on the arm, which is rotated by half a turn about z.
  const auto eye = lookup.sensor("robot", "eye");
  ASSERT_TRUE(eye);
  EXPECT_NEAR(eye->world_from_sensor.position.x, 6.9, 1e-12);
  EXPECT_NEAR(eye->world_from_sensor.position.z, 12, 1e-12);
  EXPECT_DOUBLE_EQ(eye->horizontal_fov, 1.5);
  EXPECT_FALSE(lookup.sensor("robot", "sonar"));
  EXPECT_FALSE(lookup.sensor("robot", "nose"));
}

TEST(DrawnScene, UsesThePosesOfTheSceneWithoutAMessage) {
  const DrawnScene room = Room();
  messages::gsv_msgs::Poses none;
  EXPECT_EQ(room.LookupAt(*room.At(none)).pose("robot")->position, (Vector3{1, 2, 3}));
  auto bad = Moved();
  bad.poses[0] = NAN;
  const auto snapshot = room.At(bad);
  EXPECT_EQ(room.LookupAt(*snapshot).pose("robot")->position, (Vector3{1, 2, 3}));
}

TEST(DrawnScene, KeepsLightsAndBackground) {
  const auto snapshot = Room().At({});
  const model::WorldDescription& world = *snapshot->layout->description;
  EXPECT_EQ(world.name, "room");
  EXPECT_DOUBLE_EQ(world.scene.background.b, 1);
  EXPECT_FALSE(world.scene.shadows);
  ASSERT_EQ(world.lights.size(), 1u);
  EXPECT_EQ(world.lights[0].kind, model::Light::Kind::kDirectional);
  EXPECT_EQ(world.lights[0].direction, (Vector3{0, 0, -1}));
  EXPECT_DOUBLE_EQ(world.lights[0].diffuse.g, 0.5);
  EXPECT_DOUBLE_EQ(world.lights[0].constant_attenuation, 0.5);
  EXPECT_DOUBLE_EQ(world.lights[0].quadratic_attenuation, 0.125);
}

TEST(DrawnScene, RendersTheBodiesWhereTheyAre) {
  const auto renderer = rendering::Renderer::Start();
  if (!renderer) GTEST_SKIP() << renderer.error().Sentence();
  const DrawnScene room = Room();
  const auto snapshot = room.At({});
  Camera camera;  // the camera is to the west of the robot, at its height
  camera.width = camera.height = 32;
  camera.eye = {-4, 2, 3};
  camera.target = {1, 2, 3};
  camera.field_of_view = 45;
  const auto placed = Place(camera, room.LookupAt(*snapshot));
  ASSERT_TRUE(placed);
  const auto image = (*renderer)->Draw(snapshot, *placed);
  ASSERT_TRUE(image) << image.error().Sentence();
  const auto pixel = [&](int x, int y) { return &(*image)->pixels[3 * (y * 32 + x)]; };
  // The robot's green cube is in the middle, and the blue background is at the edge.
  EXPECT_GT(pixel(16, 16)[1], 100);
  EXPECT_LT(pixel(16, 16)[2], 60);
  EXPECT_GT(pixel(1, 16)[2], 200);
  EXPECT_LT(pixel(1, 16)[1], 100);
}

TEST(DrawnScene, RejectsTextThatIsNotAScene) {
  const auto nothing = [](const std::string&) -> std::shared_ptr<const model::Model> {
    return nullptr;
  };
  EXPECT_FALSE(DrawnScene::Make("{", nothing));
  EXPECT_FALSE(DrawnScene::Make("[1, 2]", nothing));
  // A member of a wrong type is treated as missing.
  EXPECT_TRUE(DrawnScene::Make(R"({"bodies": 7, "poses": {"body": -1}, "lights": [1]})", nothing));
}

}  // namespace
}  // namespace gsv::view
