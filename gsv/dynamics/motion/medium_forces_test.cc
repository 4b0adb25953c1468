#include "gsv/dynamics/motion/medium_forces.h"

#include <gtest/gtest.h>

namespace gsv::dynamics {
namespace {

world::Layout LayoutOf(const std::shared_ptr<const model::Model>& model,
                       const model::WorldDescription& description) {
  world::Body body;
  body.name = "body";
  body.model = model;
  return *world::MakeLayout(1, {body}, std::make_shared<model::WorldDescription>(description));
}

std::shared_ptr<model::Model> BoxOf(const geometry::Pose& link_from_collision) {
  auto model = std::make_shared<model::Model>();
  model::Link link;
  link.name = "link";
  link.collisions.push_back(
      {"collision", link_from_collision, geometry::Box{{1, 1, 1}}, model::Surface{}});
  model->links.push_back(link);
  return model;
}

Wrench WrenchOfModel(const std::shared_ptr<const model::Model>& model,
                     const model::WorldDescription& description) {
  const world::Layout layout = LayoutOf(model, description);
  const Articulation articulation = MakeArticulation(*model);
  const auto media = MakeMedium(layout, layout.bodies[0], articulation);
  EXPECT_EQ(media.size(), 1u);
  const Part& part = articulation.parts[0];
  return WrenchOf(media[0], part, {part.model_from_part, {}, {}}, description, 0.001);
}

TEST(MediumForces, AreZeroWithoutAMedium) {
  const auto model = BoxOf({});
  const world::Layout layout = LayoutOf(model, {});
  EXPECT_TRUE(MakeMedium(layout, layout.bodies[0], MakeArticulation(*model)).empty());
}

// The lift acts at the centre of the volume, which is half a metre beside the centre of mass.
TEST(MediumForces, ActAtTheCentreOfTheDisplacedVolume) {
  model::WorldDescription world;
  world.fluid = model::Fluid{1000, {}, {}};
  const Wrench wrench = WrenchOfModel(BoxOf({{0.5, 0, 0}, {}}), world);
  EXPECT_NEAR(wrench.force.z, 9800, 1e-9);
  EXPECT_NEAR(wrench.torque.y, -4900, 1e-9);
  EXPECT_NEAR(wrench.torque.x, 0, 1e-9);
}

// The body is half in water, a quarter in oil, and a quarter in air.
TEST(MediumForces, AddUpTheLayersOfAFluid) {
  model::WorldDescription world;
  world.fluid = model::Fluid{1000, {{0, 800}, {0.25, 1}}, {}};
  const Wrench wrench = WrenchOfModel(BoxOf({}), world);
  EXPECT_NEAR(wrench.force.z, 9.8 * (500 + 200 + 0.25), 1e-9);
}

TEST(MediumForces, InASingleLayerEqualThoseOfAUniformFluid) {
  model::WorldDescription world;
  world.fluid = model::Fluid{1000, {{100, 0}}, {}};
  EXPECT_NEAR(WrenchOfModel(BoxOf({}), world).force.z, 9800, 1e-9);
}

}  // namespace
}  // namespace gsv::dynamics
