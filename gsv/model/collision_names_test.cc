#include "gsv/model/collision_names.h"

#include <gtest/gtest.h>

namespace gsv::model {
namespace {

Collision Named(const std::string& name) {
  Collision collision;
  collision.name = name;
  return collision;
}

Model TwoLinks() {
  Model model;
  model.links.resize(3);
  model.links[0].name = "base";
  model.links[0].collisions = {Named("body"), Named("front")};
  model.links[1].name = "arm";
  model.links[1].collisions = {Named("front"), Named("hand")};
  model.links[2].name = "inner::foot";
  model.links[2].collisions = {Named("sole")};
  return model;
}

TEST(CollisionNames, AreSearchedInTheSensorsLinkFirst) {
  const Model model = TwoLinks();
  EXPECT_EQ(FindCollision(model, 0, "front"), (CollisionIndex{0, 1}));
  EXPECT_EQ(FindCollision(model, 1, "front"), (CollisionIndex{1, 0}));
  EXPECT_EQ(FindCollision(model, 0, "hand"), (CollisionIndex{1, 1}));
}

TEST(CollisionNames, MayBeScoped) {
  const Model model = TwoLinks();
  EXPECT_EQ(FindCollision(model, 0, "arm::front"), (CollisionIndex{1, 0}));
  EXPECT_EQ(FindCollision(model, 0, "robot::arm::front"), (CollisionIndex{1, 0}));
  EXPECT_EQ(FindCollision(model, 0, "inner::foot::sole"), (CollisionIndex{2, 0}));
}

TEST(CollisionNames, MayBelongToMergedLinks) {
  const Model model = TwoLinks();
  EXPECT_EQ(FindCollision(model, 0, "base_fixed_joint_lump__hand_collision"),
            (CollisionIndex{1, 1}));
  EXPECT_EQ(FindCollision(model, 0, "base_fixed_joint_lump__hand_collision_2"),
            (CollisionIndex{1, 1}));
}

TEST(CollisionNames, UnknownNamesAreNotFound) {
  EXPECT_EQ(FindCollision(TwoLinks(), 0, "bumper"), std::nullopt);
  EXPECT_EQ(FindCollision(TwoLinks(), 0, "leg::front"), std::nullopt);
  EXPECT_EQ(FindCollision(TwoLinks(), 0, ""), std::nullopt);
}

TEST(CollisionNames, AreStoredOnePerLine) {
  SensorDescription sensor;
  EXPECT_TRUE(CollisionNamesOf(sensor).empty());
  sensor.parameters["collision"] = std::string("__default__");
  EXPECT_TRUE(CollisionNamesOf(sensor).empty());
  sensor.parameters["collision"] = std::string("front\nback side");
  EXPECT_EQ(CollisionNamesOf(sensor), (std::vector<std::string>{"front", "back side"}));
}

}  // namespace
}  // namespace gsv::model
