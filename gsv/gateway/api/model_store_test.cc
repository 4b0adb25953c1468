#include "gsv/gateway/api/model_store.h"

#include <future>
#include <thread>

#include <gtest/gtest.h>

#include "gsv/gateway/testing/arena.h"
#include "gsv/presentation/model_identity.h"

namespace gsv::gateway {
namespace {

using presentation::ModelIdentity;
using ModelPointer = std::shared_ptr<const model::Model>;

ModelPointer Crate() { return std::make_shared<model::Model>(testing::CrateModel()); }

TEST(ModelIdentity, DependsOnTheVisualsOnly) {
  const std::string id = ModelIdentity(testing::CrateModel());
  EXPECT_EQ(id, ModelIdentity(testing::CrateModel()));
  EXPECT_EQ(id.size(), 16u);

  model::Model larger = testing::CrateModel();
  larger.links[0].visuals[0].shape = geometry::Box{{1, 1, 1.5}};
  EXPECT_NE(ModelIdentity(larger), id);

  model::Model repainted = testing::CrateModel();
  repainted.links[0].visuals[0].materials[0].base_colour.g = 0.1;
  EXPECT_NE(ModelIdentity(repainted), id);

  model::Model moved = testing::CrateModel();
  moved.links[0].model_from_link.position.x = 1;
  EXPECT_NE(ModelIdentity(moved), id);

  model::Model with_map = testing::CrateModel();
  auto map = std::make_shared<model::Image>();
  map->pixels = {1, 2, 3};
  with_map.links[0].visuals[0].materials[0].base_colour_map = map;
  EXPECT_NE(ModelIdentity(with_map), id);

  // Mass and collision shapes are not drawn, so they do not change the identifier.
  model::Model heavier = testing::CrateModel();
  heavier.links[0].inertial.mass = 100;
  heavier.links[0].collisions.clear();
  EXPECT_EQ(ModelIdentity(heavier), id);
}

TEST(ModelStore, WritesEachModelOnce) {
  int written = 0;
  ModelStore store([&](const model::Model&) -> base::Result<std::vector<std::uint8_t>> {
    return std::vector<std::uint8_t>{static_cast<std::uint8_t>(++written)};
  });
  const ModelPointer one = Crate(), same = Crate();
  const std::string id = store.Identify(one);
  EXPECT_EQ(store.Identify(one), id);
  EXPECT_EQ(store.Identify(same), id);
  EXPECT_EQ(written, 0);
  EXPECT_EQ(store.Glb(id)->view(), "\x01");
  EXPECT_EQ(store.Glb(id)->view(), "\x01");
  EXPECT_EQ(written, 1);
}

TEST(ModelStore, ForgetsDestroyedModels) {
  ModelStore store([](const model::Model&) -> base::Result<std::vector<std::uint8_t>> {
    return std::vector<std::uint8_t>{1};
  });
  ModelPointer crate = Crate();
  const std::string id = store.Identify(crate);
  ASSERT_TRUE(store.Glb(id));
  crate.reset();
  EXPECT_EQ(store.Glb(id).error().code, base::ErrorCode::kNotFound);
  EXPECT_EQ(store.Glb("0123").error().code, base::ErrorCode::kNotFound);
}

TEST(ModelStore, ASlowModelDoesNotDelayOthers) {
  std::promise<void> release, begun;
  ModelStore store([&](const model::Model& model) -> base::Result<std::vector<std::uint8_t>> {
    if (model.name == "crate") {
      begun.set_value();
      release.get_future().wait();
    }
    return std::vector<std::uint8_t>{7};
  });
  const ModelPointer slow = Crate(), quick = std::make_shared<model::Model>(testing::RobotModel());
  const std::string slow_id = store.Identify(slow);
  std::thread writer([&] { EXPECT_TRUE(store.Glb(slow_id)); });
  begun.get_future().wait();
  EXPECT_TRUE(store.Glb(store.Identify(quick)));
  release.set_value();
  writer.join();
}

TEST(ModelStore, AFailureIsReturnedToAllRequests) {
  ModelStore store([](const model::Model&) -> base::Result<std::vector<std::uint8_t>> {
    return base::Fail(base::ErrorCode::kBadModel, "too large for a GLB");
  });
  const ModelPointer crate = Crate();
  const std::string id = store.Identify(crate);
  EXPECT_EQ(store.Glb(id).error().message, "too large for a GLB");
  EXPECT_EQ(store.Glb(id).error().message, "too large for a GLB");
}

TEST(ModelStore, WritesTheCollisionShapes) {
  std::vector<model::Model> written;
  ModelStore store([&](const model::Model& model) -> base::Result<std::vector<std::uint8_t>> {
    written.push_back(model);
    return std::vector<std::uint8_t>{1};
  });
  auto model = std::make_shared<model::Model>(testing::CrateModel());
  model::Link& link = model->links[0];
  link.collisions = {{"hull", geometry::Pose{{0, 0, 0.5}, {}}, geometry::Sphere{0.25}, {}},
                     {"ground", {}, geometry::Plane{}, {}}};
  const std::string id = store.IdentifyCollisions(model);
  EXPECT_NE(id, store.Identify(model));
  ASSERT_TRUE(store.Glb(id));
  ASSERT_EQ(written.size(), 1u);
  // The plane is left out, because it is infinite.
  ASSERT_EQ(written[0].links[0].visuals.size(), 1u);
  const model::Visual& shown = written[0].links[0].visuals[0];
  EXPECT_EQ(std::get<geometry::Sphere>(shown.shape).radius, 0.25);
  EXPECT_EQ(shown.link_from_visual.position.z, 0.5);

  auto bare = std::make_shared<model::Model>(testing::CrateModel());
  bare->links[0].collisions = {{"ground", {}, geometry::Plane{}, {}}};
  EXPECT_EQ(store.IdentifyCollisions(bare), "");
  EXPECT_FALSE(store.Glb(""));
}

}  // namespace
}  // namespace gsv::gateway
