#include "gsv/rendering/scene/antialiasing.h"

#include <cmath>

#include <gtest/gtest.h>

#include "gsv/rendering/scene/mesh_surfaces.h"

namespace gsv::rendering {
namespace {

constexpr int kSide = 60;

struct Drawn {
  std::vector<std::uint8_t> rgba;
  model::Image smooth;
  int Red(int x, int y) const { return smooth.pixels[3 * (y * kSide + x)]; }
};

// An image whose pixels are white if `inside` is true at their centre, otherwise black. The surface
// numbers are 1 for white and 2 for black.
template <typename Inside>
Drawn Draw(Inside inside) {
  Drawn drawn;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const bool white = inside(x + 0.5, y + 0.5);
      const std::uint8_t shade = white ? 255 : 0;
      drawn.rgba.insert(drawn.rgba.end(), {shade, shade, shade, std::uint8_t(white ? 1 : 2)});
    }
  }
  drawn.smooth = SmoothAliasedEdges(kSide, kSide, drawn.rgba.data());
  return drawn;
}

TEST(Antialiasing, BlendsEdgePixelsByTheirCoveredArea) {
  for (const double slope : {0.1, 0.23, 0.5, 2.0, 7.0, -0.3, -4.0}) {
    // the line passes through the middle
    const auto height = [&](double x) { return 30 + slope * (x - 30); };
    const Drawn drawn = Draw([&](double x, double y) { return y > height(x); });
    double error = 0, unsmoothed = 0;
    for (int y = 10; y < 50; ++y) {
      for (int x = 10; x < 50; ++x) {
        double inside = 0;  // fraction of the pixel that is white, from 400 samples
        for (int s = 0; s < 400; ++s) {
          const int column = s % 20, row = s / 20;
          inside += y + (row + 0.5) / 20 > height(x + (column + 0.5) / 20);
        }
        inside /= 400;
        error += std::abs(drawn.Red(x, y) / 255.0 - inside);
        unsmoothed += std::abs(drawn.rgba[4 * (y * kSide + x)] / 255.0 - inside);
      }
    }
    EXPECT_LT(error, 0.35 * unsmoothed) << slope;
  }
}

TEST(Antialiasing, KeepsCornersAndAxisAlignedEdgesSharp) {
  const Drawn drawn = Draw([](double x, double y) { return x > 10 && x < 40 && y > 20 && y < 50; });
  for (int p = 0; p < kSide * kSide; ++p) {
    ASSERT_EQ(drawn.smooth.pixels[3 * p], drawn.rgba[4 * p]);
  }
}

TEST(Antialiasing, KeepsTexturesUnchanged) {
  Drawn drawn = Draw([](double, double) { return true; });
  for (int p = 0; p < kSide * kSide; ++p) drawn.rgba[4 * p] = (p * 37) % 256;
  drawn.smooth = SmoothAliasedEdges(kSide, kSide, drawn.rgba.data());
  for (int p = 0; p < kSide * kSide; ++p) {
    ASSERT_EQ(drawn.smooth.pixels[3 * p], drawn.rgba[4 * p]);
  }
}

TEST(MeshSurfaces, AreConnectedPartsWithoutASharpEdge) {
  // Two triangles form a square, but have no common vertex. A third triangle is on the square's
  // edge.
  std::vector<float> vertices;
  const auto add = [&](float x, float y, float z, float nx, float nz) {
    vertices.insert(vertices.end(), {x, y, z, nx, 0, nz, 0, 0});
  };
  add(0, 0, 0, 0, 1), add(1, 0, 0, 0, 1), add(1, 1, 0, 0, 1);
  add(0, 0, 0, 0, 1), add(1, 1, 0, 0, 1), add(0, 1, 0, 0, 1);
  add(0, 0, 0, 1, 0), add(0, 1, 0, 1, 0), add(0, 0, 1, 1, 0);
  const auto surfaces = NumberSurfaces(vertices, {0, 1, 2, 3, 4, 5, 6, 7, 8});
  for (int i = 1; i < 6; ++i) EXPECT_EQ(surfaces[i], surfaces[0]);
  for (int i = 6; i < 9; ++i) EXPECT_EQ(surfaces[i], surfaces[6]);
  EXPECT_NE(surfaces[0], surfaces[6]);
}

}  // namespace
}  // namespace gsv::rendering
