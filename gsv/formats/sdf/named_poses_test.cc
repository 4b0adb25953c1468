#include "gsv/formats/sdf/named_poses.h"

#include <numbers>

#include <gtest/gtest.h>

namespace gsv::formats {
namespace {

std::vector<NamedPose> PosesIn(const char* xml) {
  model::WorldDescription world;
  const geometry::Pose turned{{2, 0, 0}, geometry::FromRollPitchYaw({0, 0, std::numbers::pi / 2})};
  world.models.push_back({"dock", nullptr, turned, true});
  tinyxml2::XMLDocument document;
  document.Parse(xml);
  return NamedPosesIn(*document.RootElement(), world);
}

TEST(NamedPoses, MayBeRelativeToModelsAndToEachOther) {
  const auto poses = PosesIn(
      "<world><frame name='charge' attached_to='dock'><pose>1 0 0 0 0 0</pose></frame>"
      "<frame name='wait'><pose relative_to='charge'>0 3 0 0 0 0</pose></frame>"
      "<frame name='home'><pose>4 5 0 0 0 0</pose></frame></world>");
  ASSERT_EQ(poses.size(), 3u);
  EXPECT_EQ(poses[0].name, "charge");
  EXPECT_NEAR(poses[0].world_from_pose.position.x, 2, 1e-12);
  EXPECT_NEAR(poses[0].world_from_pose.position.y, 1, 1e-12);
  EXPECT_NEAR(poses[1].world_from_pose.position.x, -1, 1e-12);
  EXPECT_NEAR(poses[1].world_from_pose.position.y, 1, 1e-12);
  EXPECT_EQ(poses[2].world_from_pose.position, (geometry::Vector3{4, 5, 0}));
}

TEST(NamedPoses, LeaveOutFramesWithoutAPose) {
  const auto poses = PosesIn(
      "<world><frame name='a'><pose relative_to='b'/></frame>"
      "<frame name='b'><pose relative_to='a'/></frame><frame><pose>1 0 0 0 0 0</pose></frame>"
      "<frame name='c'><pose>1 2</pose></frame><frame name='d' attached_to='nothing'/></world>");
  EXPECT_TRUE(poses.empty());
}

}  // namespace
}  // namespace gsv::formats
