// Tests the built-in worlds and robots, as a user reads them.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gsv/formats/sdf_reader.h"

namespace gsv {
namespace {

namespace fs = std::filesystem;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

fs::path AssetsFolder() {
  const char* source = std::getenv("GSV_SOURCE_DIR");
  return fs::path(source == nullptr ? "." : source) / "assets";
}

std::vector<std::string> Sentences(const base::Problems& problems) {
  std::vector<std::string> sentences;
  for (const base::Problem& problem : problems) sentences.push_back(problem.Sentence());
  return sentences;
}

class Assets : public testing::Test {
 protected:
  std::shared_ptr<const model::Model> Robot(const std::string& name) {
    base::Problems problems;
    const auto model = library_.ReadModel((AssetsFolder() / "models" / name).string(), problems);
    EXPECT_THAT(Sentences(problems), IsEmpty());
    if (!model) {
      ADD_FAILURE() << model.error().Sentence();
      return nullptr;
    }
    return *model;
  }

  formats::ModelLibrary library_{formats::ReadOptions{{AssetsFolder() / "models"}, true, {}}};
};

std::ptrdiff_t CountSensors(const model::Model& model, const std::string& type) {
  return std::count_if(model.sensors.begin(), model.sensors.end(),
                       [&](const auto& sensor) { return sensor.type == type; });
}

TEST_F(Assets, EveryFileReadsWithoutAWarning) {
  std::vector<std::string> worlds;
  for (const auto& entry : fs::directory_iterator(AssetsFolder() / "worlds")) {
    base::Problems problems;
    const auto world = library_.ReadWorld(entry.path(), problems);
    ASSERT_TRUE(world) << world.error().Sentence();
    EXPECT_THAT(Sentences(problems), IsEmpty()) << entry.path();
    EXPECT_EQ(world->max_step_size, std::chrono::milliseconds(10));
    worlds.push_back(world->name);
  }
  EXPECT_THAT(worlds,
              UnorderedElementsAre("office", "hall", "maze", "warehouse", "yard", "playground"));
  for (const auto& entry : fs::directory_iterator(AssetsFolder() / "models")) {
    if (fs::exists(entry.path() / "model.sdf")) Robot(entry.path().filename());
  }
}

TEST_F(Assets, B21rHas24SonarsACameraAndASynchroDrive) {
  const auto b21r = Robot("b21r");
  ASSERT_NE(b21r, nullptr);
  EXPECT_EQ(CountSensors(*b21r, "sonar"), 24);
  EXPECT_EQ(CountSensors(*b21r, "camera"), 1);
  ASSERT_TRUE(b21r->drive);
  EXPECT_EQ(b21r->drive->kind, model::DriveKind::kSynchro);
  EXPECT_EQ(b21r->drive->command_timeout, std::chrono::seconds(1));
  // The radius of the drum is 0.263 m. FootprintRadius() reaches the corners of the box around the
  // drum, which are farther away.
  EXPECT_NEAR(model::FootprintRadius(*b21r), 0.263, 0.12);
  EXPECT_NEAR(model::LowestPoint(*b21r), 0, 1e-9);
}

TEST_F(Assets, SmallRobotsHaveADifferentialDriveOnAllTheirWheels) {
  const auto pebble = Robot("pebble");
  const auto rover = Robot("rover4");
  ASSERT_TRUE(pebble && pebble->drive && rover && rover->drive);
  EXPECT_EQ(pebble->drive->kind, model::DriveKind::kDifferential);
  EXPECT_EQ(pebble->drive->left_wheels.size(), 1u);
  EXPECT_EQ(rover->drive->kind, model::DriveKind::kDifferential);
  EXPECT_EQ(rover->drive->left_wheels.size(), 2u);
  EXPECT_EQ(rover->drive->right_wheels.size(), 2u);
  EXPECT_DOUBLE_EQ(rover->drive->wheel_radius, 0.11);
  EXPECT_NEAR(model::LowestPoint(*rover), 0, 1e-6);
  EXPECT_NEAR(model::LowestPoint(*pebble), 0, 1e-6);
}

TEST_F(Assets, AvatarAcceptsAnyVelocity) {
  const auto avatar = Robot("avatar");
  ASSERT_TRUE(avatar && avatar->drive);
  EXPECT_EQ(avatar->drive->kind, model::DriveKind::kVelocity);
}

TEST_F(Assets, MaterialsHaveTheirTextures) {
  const auto building = Robot("office_building");
  ASSERT_NE(building, nullptr);
  int textured = 0;
  for (const model::Visual& visual : building->links.front().visuals) {
    ASSERT_FALSE(visual.materials.empty()) << visual.name;
    if (visual.materials.front().base_colour_map != nullptr) ++textured;
  }
  EXPECT_EQ(textured, 5);  // plaster, wood, oak, carpet and tiles; glass has no texture
}

}  // namespace
}  // namespace gsv
