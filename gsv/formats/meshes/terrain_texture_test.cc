#include "gsv/formats/meshes/terrain_texture.h"

#include <gtest/gtest.h>

#include "gsv/formats/meshes/heightmap.h"

namespace gsv::formats {
namespace {

using Pixel = std::array<int, 3>;

std::shared_ptr<const model::Image> ImageOf(int width, int height,
                                            const std::vector<Pixel>& pixels) {
  auto image = std::make_shared<model::Image>();
  image->width = width;
  image->height = height;
  for (const Pixel& pixel : pixels) {
    for (const int c : pixel) image->pixels.push_back(static_cast<std::uint8_t>(c));
  }
  return image;
}

// Returns a ramp that rises along x from 0 to 10 m, over 10 m.
geometry::TriangleMesh Ramp() {
  model::Image grey{2, 2, 3, {0, 0, 0, 255, 255, 255, 0, 0, 0, 255, 255, 255}, "ramp"};
  return HeightmapMesh(grey, {10, 10, 10}, 100);
}

// Returns the pixel at a point of the terrain, in metres from its lower left corner.
Pixel At(const model::Image& image, double x, double y) {
  const auto column = static_cast<std::size_t>(x / 10 * image.width);
  const auto row = static_cast<std::size_t>((1 - y / 10) * image.height);
  const std::uint8_t* p = &image.pixels[(row * static_cast<std::size_t>(image.width) + column) * 3];
  return {p[0], p[1], p[2]};
}

constexpr Pixel kRed{200, 0, 0}, kGreen{0, 200, 0}, kBlue{0, 0, 200}, kWhite{250, 250, 250};

TEST(TerrainTexture, RepeatsATileFromTheLowerLeftCorner) {
  const auto tile = ImageOf(2, 2, {kRed, kGreen, kBlue, kWhite});
  const model::Image image = TerrainTexture(Ramp(), {10, 10}, {{tile, 5}});
  for (const double x : {0.0, 5.0}) {
    for (const double y : {0.0, 5.0}) {
      EXPECT_EQ(At(image, x + 1.25, y + 1.25), kBlue);
      EXPECT_EQ(At(image, x + 3.75, y + 1.25), kWhite);
      EXPECT_EQ(At(image, x + 1.25, y + 3.75), kRed);
      EXPECT_EQ(At(image, x + 3.75, y + 3.75), kGreen);
    }
  }
}

TEST(TerrainTexture, BlendsLayersByHeight) {
  const auto low = ImageOf(1, 1, {kRed}), high = ImageOf(1, 1, {kBlue});
  const model::Image image = TerrainTexture(Ramp(), {10, 10}, {{low, 1, 0, 0}, {high, 1, 4, 4}});
  EXPECT_EQ(At(image, 1, 5), kRed);
  EXPECT_EQ(At(image, 9, 5), kBlue);
  // At x = 6 m the height is 6 m, which is the middle of the blue layer's fading distance (4 to
  // 8 m).
  EXPECT_NEAR(At(image, 6, 5)[0], 100, 3);
  EXPECT_NEAR(At(image, 6, 5)[2], 100, 3);
}

TEST(TerrainTexture, AveragesTilesThatAreTooFine) {
  const auto tile = ImageOf(2, 1, {{0, 0, 0}, {200, 200, 200}});
  const model::Image image = TerrainTexture(Ramp(), {10, 10}, {{tile, 10.0 / 4096}});
  EXPECT_EQ(image.width, kTerrainTextureSide);
  EXPECT_NEAR(At(image, 5, 5)[0], 100, 1);
}

TEST(TerrainTexture, IsGreyWhereATextureIsMissing) {
  const model::Image image = TerrainTexture(Ramp(), {10, 10}, {{nullptr, 1}});
  EXPECT_EQ(At(image, 5, 5), (Pixel{128, 128, 128}));
}

}  // namespace
}  // namespace gsv::formats
