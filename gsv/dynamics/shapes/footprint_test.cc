#include "gsv/dynamics/shapes/footprint.h"

#include <gtest/gtest.h>

#include "gsv/dynamics/testing/test_world.h"

namespace gsv::dynamics {
namespace {

using geometry::PlanarPose;
using testing::LinkOf;

TEST(Footprint, OmitsPiecesInsideAnother) {
  auto model = testing::BoxRobot(0.6, 0.4);  // 0.4 high
  model->links.push_back(LinkOf(geometry::Sphere{0.1}, PlanarPose(0, 0, 0.2, 0)));
  model->links.push_back(LinkOf(geometry::Box{{0.6, 0.4, 0.4}}, PlanarPose(0, 0, 0.2, 0)));
  const Footprint footprint = MakeFootprint(*model, {});
  ASSERT_EQ(footprint.pieces.size(), 1u);
  EXPECT_NEAR(footprint.radius, std::hypot(0.3, 0.2), 1e-12);
  EXPECT_NEAR(footprint.heights.low, 0, 1e-12);
  EXPECT_NEAR(footprint.heights.high, 0.4, 1e-12);
}

TEST(Footprint, KeepsAMastAboveTheBase) {
  auto model = testing::BoxRobot(0.6, 0.4);
  model->links.push_back(LinkOf(geometry::Cylinder{0.05, 1}, PlanarPose(0.1, 0, 0.9, 0)));
  const Footprint footprint = MakeFootprint(*model, {});
  ASSERT_EQ(footprint.pieces.size(), 2u);
  EXPECT_NEAR(footprint.pieces[1].heights.high, 1.4, 1e-12);
  EXPECT_EQ(footprint.pieces[1].shape.vertex_count, 1);
}

TEST(Footprint, OfManyPartsIsAFewLayersAroundThem) {
  auto model = std::make_shared<model::Model>();
  for (int i = 0; i < 300; ++i) {
    model->links.push_back(
        LinkOf(geometry::Sphere{0.05}, PlanarPose(0.01 * i, 0.3 * (i % 5), 0.02 * i, 0)));
  }
  const Footprint footprint = MakeFootprint(*model, {});
  EXPECT_LE(footprint.pieces.size(), std::size_t{Footprint::kMaxPieces});
  for (int i = 0; i < 300; ++i) {
    const double z = 0.02 * i;
    bool held = false;
    for (const auto& piece : footprint.pieces) {
      held = held || (piece.heights.low <= z && z <= piece.heights.high &&
                      Contains(piece.shape, Disc({0.01 * i, 0.3 * (i % 5)}, 0.05), 1e-9));
    }
    EXPECT_TRUE(held) << i;
  }
}

TEST(Footprint, OfAModelWithoutCollisionsIsEmpty) {
  model::Model model;
  model.links.resize(1);
  EXPECT_TRUE(MakeFootprint(model, {}).pieces.empty());
}

TEST(ClimbHeight, IsHalfAWheelWithinBounds) {
  auto model = testing::BoxRobot(0.6, 0.4);
  const Footprint footprint = MakeFootprint(*model, {});
  for (const auto& [radius, climb] : {std::pair{0.005, 0.01}, {0.033, 0.0165}, {0.5, 0.05}}) {
    model->drive->wheel_radius = radius;
    EXPECT_DOUBLE_EQ(ClimbHeight(*model, footprint), climb);
  }
  const auto flat = testing::RobotOf(geometry::Box{{0.3, 0.3, 0.02}}, 0.02);
  EXPECT_DOUBLE_EQ(ClimbHeight(*flat, MakeFootprint(*flat, {})), 0.01);
}

}  // namespace
}  // namespace gsv::dynamics
