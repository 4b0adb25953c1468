#include "gsv/sensing/rays/ground.h"

#include <gtest/gtest.h>

#include "gsv/sensing/testing/test_snapshot.h"

namespace gsv::sensing {
namespace {

using testing::MakeSnapshot;
using testing::ModelOf;

TEST(FloorHeight, IsTheHeightOfTheHighestFloorAndIgnoresTables) {
  RaySceneCache cache;
  const auto scene = cache.At(MakeSnapshot({
      {"plane", ModelOf(geometry::Plane{}), {}, true},
      {"slab", ModelOf(geometry::Box{{4, 4, 0.19}}), {{0, 0, 0.095}, {}}, true},
      {"table", ModelOf(geometry::Box{{1, 1, 0.05}}), {{0, 0, 0.9}, {}}, true},
      {"wall", ModelOf(geometry::Box{{1, 1, 2}}), {{20, 0, 1}, {}}, true},
  }));
  EXPECT_NEAR(FloorHeight(*scene, 0, 0), 0.19, 1e-12);
  EXPECT_NEAR(FloorHeight(*scene, 1.9, 1.9), 0.19, 1e-12);
  EXPECT_NEAR(FloorHeight(*scene, 5, 0), 0, 1e-12);
  EXPECT_NEAR(FloorHeight(*scene, 20, 0), 0, 1e-12);  // the place is inside the wall
}

TEST(FloorHeight, IsZeroWithoutAFloor) {
  RaySceneCache cache;
  const auto scene =
      cache.At(MakeSnapshot({{"far", ModelOf(geometry::Sphere{1}), {{9, 9, 9}, {}}, true}}));
  EXPECT_EQ(FloorHeight(*scene, 0, 0), 0);
}

TEST(FloorHeight, IsNegativeForAFloorBelowZero) {
  RaySceneCache cache;
  const auto scene =
      cache.At(MakeSnapshot({{"pit", ModelOf(geometry::Plane{}), {{0, 0, -2}, {}}, true}}));
  EXPECT_NEAR(FloorHeight(*scene, 3, 4), -2, 1e-12);
}

}  // namespace
}  // namespace gsv::sensing
