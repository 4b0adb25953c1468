// Tests that worlds and robots of other authors can be read, with warnings only about missing
// parts.
#include <algorithm>
#include <chrono>
#include <set>

#include <gmock/gmock.h>

#include "gsv/formats/files/resource_finder.h"
#include "gsv/formats/sdf_reader.h"
#include "gsv/formats/testing/real_folder.h"

namespace gsv::formats {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

class RealFilesTest : public testing::Test {
 protected:
  void SetUp() override {
    if (RealFolder().empty()) GTEST_SKIP() << "GSV_REAL_DIR names no folder of real worlds";
  }
};

// Whether the warning is about a missing file, an unsupported element, an inertia that no body can
// have, or the one stray character in these files. They have no misspelt elements.
bool IsKnownFlaw(const base::Problem& problem) {
  if (problem.severity != base::Problem::Severity::kWarning) return false;
  for (const char* known :
       {"bases/burger_base.stl", "bases/waffle_base.stl", "bases/waffle_pi_base.stl",
        "sensors/astra.dae", "models/Construction Cone", "models/Mecanum lift", " is not supported",
        "more elements are unknown or not supported", "no body has this inertia",
        "the text \"\"\" in <sensor>"}) {
    if (problem.message.find(known) != std::string::npos) return true;
  }
  return false;
}

void ExpectOnlyKnownFlaws(const base::Problems& problems, const fs::path& file) {
  for (const auto& problem : problems) {
    EXPECT_TRUE(IsKnownFlaw(problem)) << file << ": " << problem.Sentence();
  }
}

TEST_F(RealFilesTest, EveryWorldLoads) {
  for (const char* name :
       {"gz_sim_worlds/3k_shapes.sdf", "gz_sim_worlds/ackermann_steering.sdf",
        "gz_sim_worlds/camera_sensor.sdf", "gz_sim_worlds/cpu_lidar_sensor.sdf",
        "gz_sim_worlds/diff_drive.sdf", "gz_sim_worlds/lights.sdf",
        "gz_sim_worlds/mecanum_drive.sdf", "gz_sim_worlds/nested_model.sdf",
        "gz_sim_worlds/polylines.sdf", "gz_sim_worlds/sensors_demo.sdf", "gz_sim_worlds/shapes.sdf",
        "turtlebot3/worlds/empty_world.world", "turtlebot3/worlds/turtlebot3_house.world",
        "turtlebot3/worlds/turtlebot3_world.world"}) {
    base::Problems problems;
    const auto world = ModelLibrary().ReadWorld(RealFolder() / name, problems);
    ASSERT_TRUE(world.has_value()) << world.error().Sentence();
    EXPECT_FALSE(world->models.empty()) << name;
    EXPECT_FALSE(world->lights.empty()) << name;
    ExpectOnlyKnownFlaws(problems, name);
  }
}

// The models are listed by name, because the folder also contains a light (sun) and the meshes of
// other models (turtlebot3_common).
TEST_F(RealFilesTest, EveryModelLoads) {
  for (const char* name : {"gazebo_models/bookshelf",
                           "gazebo_models/cafe",
                           "gazebo_models/cafe_table",
                           "gazebo_models/create",
                           "gazebo_models/ground_plane",
                           "gazebo_models/hokuyo",
                           "gazebo_models/kinect",
                           "gazebo_models/pioneer2dx",
                           "gazebo_models/pioneer3at",
                           "gazebo_models/turtlebot",
                           "gazebo_models/willowgarage",
                           "turtlebot3/models/turtlebot3_burger",
                           "turtlebot3/models/turtlebot3_burger_cam",
                           "turtlebot3/models/turtlebot3_house",
                           "turtlebot3/models/turtlebot3_house/cafe_table",
                           "turtlebot3/models/turtlebot3_house/first_2015_trash_can",
                           "turtlebot3/models/turtlebot3_house/mailbox",
                           "turtlebot3/models/turtlebot3_house/table_marble",
                           "turtlebot3/models/turtlebot3_waffle",
                           "turtlebot3/models/turtlebot3_waffle_pi",
                           "turtlebot3/models/turtlebot3_world",
                           "turtlebot3/turtlebot3_description/urdf/turtlebot3_burger.urdf",
                           "turtlebot3/turtlebot3_description/urdf/turtlebot3_waffle.urdf",
                           "turtlebot3/turtlebot3_description/urdf/turtlebot3_waffle_pi.urdf"}) {
    base::Problems problems;
    const auto model = ModelLibrary().ReadModel((RealFolder() / name).string(), problems);
    ASSERT_TRUE(model.has_value()) << model.error().Sentence();
    EXPECT_FALSE((*model)->links.empty()) << name;
    ExpectOnlyKnownFlaws(problems, name);
  }
}

TEST_F(RealFilesTest, TurtleBot3HouseAndBurgerLackOneMesh) {
  ModelLibrary library;
  base::Problems problems;
  const fs::path turtlebot3 = RealFolder() / "turtlebot3";
  const auto world = library.ReadWorld(turtlebot3 / "worlds/turtlebot3_house.world", problems);
  ASSERT_TRUE(world.has_value());
  ExpectOnlyKnownFlaws(problems, "turtlebot3_house.world");
  EXPECT_FALSE(world->scene.shadows);
  EXPECT_EQ(world->max_step_size, std::chrono::milliseconds(1));
  ASSERT_THAT(world->models, SizeIs(2));
  EXPECT_TRUE(world->models[1].is_static);
  int textured = 0;
  std::set<const void*> pictures;
  for (const auto& link : world->models[1].model->links) {
    for (const auto& visual : link.visuals) {
      for (const auto& material : visual.materials) {
        if (material.base_colour_map == nullptr) continue;
        ++textured;
        pictures.insert(material.base_colour_map.get());
      }
    }
  }
  EXPECT_GT(textured, 90);          // Nearly all visuals have a texture, such as bricks or wood.
  EXPECT_LT(pictures.size(), 12u);  // each image is read once

  const auto burger =
      library.ReadModel("turtlebot3_burger", problems, turtlebot3 / "worlds/x.world");
  ASSERT_TRUE(burger.has_value());
  ExpectOnlyKnownFlaws(problems, "turtlebot3_burger");
  EXPECT_TRUE(std::any_of(problems.begin(), problems.end(), [](const base::Problem& problem) {
    return problem.message.find("turtlebot3_common/meshes/bases/burger_base.stl") !=
           std::string::npos;
  }));
  EXPECT_EQ((*burger)->links[0].name, "base_footprint");
  ASSERT_TRUE((*burger)->drive.has_value());
  EXPECT_EQ((*burger)->drive->wheel_separation, 0.160);
  EXPECT_EQ((*burger)->drive->wheel_radius, 0.033);
  EXPECT_EQ((*burger)->drive->linear_acceleration.max, 1);
  ASSERT_THAT((*burger)->sensors, SizeIs(2));
  EXPECT_EQ(model::NumberOr((*burger)->sensors[1].parameters, "scan.horizontal.samples", 0), 360);
  // The mesh of the base's visual is missing, so its collision box is drawn instead.
  EXPECT_TRUE(std::holds_alternative<geometry::Box>((*burger)->links[1].visuals.at(0).shape));
}

TEST_F(RealFilesTest, TurtleBot3WorldStandsUpright) {
  // The meshes declare Y_UP but have z up. The arena is 0.25 * 200 inches high and begins 0.3 m
  // below the ground.
  base::Problems problems;
  const auto world =
      ModelLibrary().ReadWorld(RealFolder() / "turtlebot3/worlds/turtlebot3_world.world", problems);
  ASSERT_TRUE(world.has_value());
  int walls = 0;
  for (const auto& link : world->models.back().model->links) {
    for (const auto& visual : link.visuals) {
      const auto* mesh = std::get_if<geometry::Mesh>(&visual.shape);
      if (mesh == nullptr || visual.name != "body") continue;
      const auto bounds = geometry::BoundsOf(visual.shape);
      EXPECT_NEAR(bounds.min.z, 0, 1e-6);
      EXPECT_NEAR(bounds.max.z, 0.25 * 200 * 0.0254, 1e-6);
      ++walls;
    }
  }
  EXPECT_EQ(walls, 1);
}

TEST_F(RealFilesTest, MeasuresTheDriveOfThePioneer) {
  base::Problems problems;
  const auto pioneer =
      ModelLibrary().ReadModel((RealFolder() / "gazebo_models/pioneer2dx").string(), problems);
  ASSERT_TRUE(pioneer.has_value());
  ASSERT_TRUE((*pioneer)->drive.has_value());
  EXPECT_NEAR((*pioneer)->drive->wheel_separation, 0.34, 1e-9);  // the wheels are at y = ±0.17
  EXPECT_NEAR((*pioneer)->drive->wheel_radius, 0.11, 1e-9);
  // The axis is given in the model's frame: both wheels rotate about y.
  for (const auto& joint : (*pioneer)->joints) {
    EXPECT_NEAR((joint.model_from_joint.orientation * joint.axis).y, 1, 1e-9);
  }
}

TEST_F(RealFilesTest, ReadsModelsOfBuildingsAsWorlds) {
  for (const char* name : {"cafe", "willowgarage"}) {
    base::Problems problems;
    const auto world = ModelLibrary().ReadWorld(RealFolder() / "gazebo_models" / name, problems);
    ASSERT_TRUE(world.has_value()) << world.error().Sentence();
    ExpectOnlyKnownFlaws(problems, name);
    ASSERT_THAT(world->models, SizeIs(2));
    EXPECT_EQ(world->models[0].name, "ground_plane");
    const auto& visual = world->models[1].model->links.at(0).visuals.at(0);
    EXPECT_GT(std::get<geometry::Mesh>(visual.shape).triangles->triangles.size(), 1000u);
  }
}

}  // namespace
}  // namespace gsv::formats
