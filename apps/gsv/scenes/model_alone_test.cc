#include "apps/gsv/scenes/model_alone.h"

#include <gtest/gtest.h>

namespace gsv::app {
namespace {

std::shared_ptr<const model::Model> ModelOfBox(const geometry::Vector3& size) {
  auto model = std::make_shared<model::Model>();
  model->links.resize(1);
  model->links[0].visuals.resize(1);
  model->links[0].visuals[0].shape = geometry::Box{size};
  return model;
}

TEST(ModelAlone, StandsOnTheGroundWhereverItsOriginIs) {
  model::WorldDescription world;
  world.name = "walker";
  auto walker = std::make_shared<model::Model>(*ModelOfBox({0.4, 0.4, 1.6}));
  walker->name = "walker";
  world.models.push_back({"ground_plane", ModelOfBox({1, 1, 1}), {}, true});
  world.models.push_back({"walker", walker, {{0, 0, 0.3}, {}}, false});
  ASSERT_TRUE(IsModelAlone(world));
  StandModelOnGround(world);
  EXPECT_DOUBLE_EQ(world.models.back().world_from_model.position.z, 0.8);
  world.name = "hall";
  EXPECT_FALSE(IsModelAlone(world));
}

}  // namespace
}  // namespace gsv::app
