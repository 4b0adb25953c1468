#include "gsv/formats/sdf/world_frames.h"

#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gsv::formats {
namespace {

using geometry::Pose;
using geometry::Vector3;

base::Result<WrittenPose> Parsed(const char* xml) {
  tinyxml2::XMLDocument document;
  document.Parse(xml);
  return ReadPose(*document.RootElement());
}

TEST(ReadPose, ReadsAnglesDegreesAndQuaternions) {
  const double quarter = std::numbers::pi / 2;
  const Vector3 x{1, 0, 0};
  for (const char* xml :
       {"<m><pose>1 2 3 0 0 1.5707963267948966</pose></m>",
        "<m><pose degrees='true'>1 2 3 0 0 90</pose></m>",
        "<m><pose rotation_format='quat_xyzw'>1 2 3 0 0 0.70710678118 0.70710678118</pose></m>"}) {
    const auto written = Parsed(xml);
    ASSERT_TRUE(written.has_value()) << xml;
    EXPECT_EQ(written->pose.position, (Vector3{1, 2, 3}));
    EXPECT_NEAR(geometry::Yaw(written->pose.orientation), quarter, 1e-9);
    EXPECT_NEAR((written->pose.orientation * x).y, 1, 1e-9);
  }
  EXPECT_EQ(Parsed("<m/>")->pose, Pose{});
  EXPECT_EQ(Parsed("<m><pose frame=''/></m>")->pose, Pose{});
  EXPECT_EQ(Parsed("<m><pose relative_to='b'/></m>")->relative_to, "b");
  EXPECT_FALSE(Parsed("<m><pose>1 2 3</pose></m>").has_value());
  EXPECT_FALSE(Parsed("<m><pose>nan 0 0 0 0 0</pose></m>").has_value());
}

TEST(WorldFrames, ComposesChainsThroughModelsAndTheirFrames) {
  WorldFrames frames;
  const double quarter = std::numbers::pi / 2;
  const std::map<std::string, Pose> inner = {{"tray", {{0, 0, 0.5}, {}}}};
  frames.Add("table", {geometry::PlanarPose(1, 2, 0, quarter), ""}, {}, &inner);
  frames.Add("cup", {{{1, 0, 0}, {}}, "table::tray"});
  // The table's x axis points along the world's y axis.
  const auto world_from_cup = frames.WorldFrom("cup");
  ASSERT_TRUE(world_from_cup.has_value());
  EXPECT_NEAR(world_from_cup->position.x, 1, 1e-12);
  EXPECT_NEAR(world_from_cup->position.y, 3, 1e-12);
  EXPECT_NEAR(world_from_cup->position.z, 0.5, 1e-12);
}

TEST(WorldFrames, PlacesAModelByAFrameWithinIt) {
  WorldFrames frames;
  const Pose model_from_foot{{0, 0, -2}, {}};
  frames.Add("lamp", {{{5, 0, 0}, {}}, ""}, geometry::Inverse(model_from_foot));
  EXPECT_EQ(frames.WorldFrom("lamp")->position, (Vector3{5, 0, 2}));
}

TEST(WorldFrames, RefusesCyclesAndUnknownNames) {
  WorldFrames frames;
  frames.Add("a", {{}, "b"});
  frames.Add("b", {{}, "a"});
  EXPECT_THAT(frames.WorldFrom("a").error().message, testing::HasSubstr("cycle"));
  EXPECT_THAT(frames.WorldFrom("c").error().message, testing::HasSubstr("frame \"c\", which"));
}

}  // namespace
}  // namespace gsv::formats
