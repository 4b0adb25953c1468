#include "gsv/rendering/raster/raster_texture.h"

#include <cmath>

#include <gtest/gtest.h>

#include "gsv/rendering/raster/raster_batch_renderer.h"

namespace gsv::rendering::raster {
namespace {

model::Image ImageOf(int width, int height) {
  model::Image image;
  image.width = width, image.height = height;
  for (int i = 0; i < width * height; ++i) {
    image.pixels.insert(image.pixels.end(), {static_cast<std::uint8_t>(i * 37), 0, 255});
  }
  return image;
}

// The red channel of an image that repeats, interpolated between the centres of pixels.
double RedAt(const model::Image& image, double u, double v) {
  const double x = u * image.width - 0.5, y = v * image.height - 0.5;
  const auto red = [&](int dx, int dy) {
    const auto repeated = [](double at, int size) {
      const int whole = static_cast<int>(std::floor(at)) % size;
      return whole < 0 ? whole + size : whole;
    };
    const int pixel = repeated(y + dy, image.height) * image.width + repeated(x + dx, image.width);
    return image.pixels[static_cast<std::size_t>(3 * pixel)] / 255.0;
  };
  const double fx = x - std::floor(x), fy = y - std::floor(y);
  return (1 - fy) * ((1 - fx) * red(0, 0) + fx * red(1, 0)) +
         fy * ((1 - fx) * red(0, 1) + fx * red(1, 1));
}

TEST(RasterTexture, RepeatsAcrossItsEdges) {
  if (!CanRasterise()) GTEST_SKIP() << "needs AVX2";
  for (const auto& [width, height] : {std::pair{8, 4}, {5, 7}, {1, 3}, {1, 1}}) {
    const model::Image image = ImageOf(width, height);
    const auto texture = std::static_pointer_cast<RasterTexture>(MakeRasterTexture(image));
    for (double v = -1.03; v < 2; v += 0.057) {
      for (double u = -1.01; u < 2; u += 0.41) {
        const F8 across = Splat(static_cast<float>(u)) + Steps() * Splat(0.05f);
        const Texels<F8> found =
            Sample(*texture, MipLevels<F8>(*texture, Splat(0)), across,
                   Splat(static_cast<float>(v)), EqualInt(IntSteps(), IntSteps()));
        for (int lane = 0; lane < 8; ++lane) {
          EXPECT_NEAR(found.r[lane], RedAt(image, across[lane], v), 2e-5)
              << width << "×" << height << " at " << across[lane] << ", " << v;
        }
      }
    }
  }
}

// Each level has half the size of the one before, and a vector may look up all of them.
TEST(RasterTexture, LanesHaveTheirOwnLevels) {
  if (!CanRasterise()) GTEST_SKIP() << "needs AVX2";
  const auto texture = std::static_pointer_cast<RasterTexture>(MakeRasterTexture(ImageOf(128, 2)));
  ASSERT_EQ(texture->level_count, 8);
  for (int level = 0; level < 8; ++level) {
    EXPECT_EQ(texture->width[level], 128 >> level);
    EXPECT_EQ(texture->height[level], level == 0 ? 2 : 1);
  }
  const F8 u = Splat(0.3f), v = Splat(0.7f);
  const Texels<F8> together =
      Sample(*texture, MipLevels<F8>(IntSteps(), Splat(0)), u, v, EqualInt(IntSteps(), IntSteps()));
  for (int level = 0; level < 8; ++level) {
    const Texels<F8> alone = Sample(*texture, MipLevels<F8>(SplatInt(level), Splat(0)), u, v,
                                    EqualInt(IntSteps(), IntSteps()));
    EXPECT_EQ(together.r[level], alone.r[0]) << level;
  }
}

}  // namespace
}  // namespace gsv::rendering::raster
