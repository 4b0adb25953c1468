#include "gsv/formats/meshes/heightmap.h"

#include <gtest/gtest.h>

namespace gsv::formats {
namespace {

model::Image Ramp(int width, int height) {
  model::Image image{width, height, 3, {}, "ramp"};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image.pixels.insert(image.pixels.end(), 3, static_cast<std::uint8_t>(255 * x / (width - 1)));
    }
  }
  return image;
}

TEST(Heightmap, HasItsSizeAndHeightsProportionalToTheGreyValues) {
  const auto mesh = HeightmapMesh(Ramp(6, 4), {10, 6, 2}, 100);
  EXPECT_EQ(mesh.positions.size(), 24u);
  EXPECT_EQ(mesh.triangles.size(), 2u * 5 * 3);
  const auto bounds = geometry::BoundsOf(mesh);
  EXPECT_EQ(bounds.min, (geometry::Vector3{-5, -3, 0}));
  EXPECT_EQ(bounds.max, (geometry::Vector3{5, 3, 2}));
  for (const auto& p : mesh.positions) EXPECT_NEAR(p.z, (p.x + 5) / 10 * 2, 1e-12);
  // The slope 0.2 along x: normal (-0.2, 0, 1), normalised.
  for (const auto& n : mesh.normals) EXPECT_NEAR(n.x / n.z, -0.2, 1e-9);
}

TEST(Heightmap, SamplesLargeImagesDown) {
  const auto mesh = HeightmapMesh(Ramp(256, 256), {1, 1, 1}, 17);
  EXPECT_EQ(mesh.positions.size(), 17u * 17);
}

}  // namespace
}  // namespace gsv::formats
