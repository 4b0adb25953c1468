#include "gsv/rendering/raster/shadow_bounds.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "gsv/base/random.h"
#include "gsv/rendering/raster/raster_batch_renderer.h"

namespace gsv::rendering::raster {
namespace {

constexpr int kStride = kShadowSide + 16;
constexpr std::ptrdiff_t kFirst = kStride + 1;  // the index of texel (0, 0)

class Map {
 public:
  Map() : texels_(std::size_t{kStride} * (kShadowSide + 2)) {}
  float& At(int x, int y) {
    return texels_[static_cast<std::size_t>(kFirst + std::ptrdiff_t{kStride} * y + x)];
  }
  void Fill(const ShadowRegion::Rectangle& part, const auto& depth) {
    for (int y = part.min_y; y < part.max_y; ++y) {
      for (int x = part.min_x; x < part.max_x; ++x) At(x, y) = static_cast<float>(depth(x, y));
    }
  }
  void UpdateBounds(const ShadowRegion::Rectangle& part) {
    bounds_.Update(&texels_[kFirst], kStride, {&part, 1}, team_);
  }
  // The bounds at eight points to the right of (x, y), 0.37 texels apart.
  ShadowBounds::Range<F8> BoundsAt(double x, double y) const {
    return bounds_.At(Splat(static_cast<float>(x)) + Steps() * Splat(0.37f),
                      Splat(static_cast<float>(y)));
  }
  // The lowest and the highest texel that a look-up reads at (x, y).
  std::pair<float, float> RangeAt(double x, double y) {
    float lowest = 1e9, highest = -1e9;
    for (const double sign : {-1, 1}) {
      const auto first = [&](double at, double offset) {
        return static_cast<int>(
            std::floor(std::clamp(at + sign * offset, -0.5, kShadowSide + 0.4) - 0.5));
      };
      for (const int dx : {0, 1}) {
        for (const int dy : {0, 1}) {
          const float depth = At(first(x, 0.6) + dx, first(y, 0.3) + dy);
          lowest = std::min(lowest, depth), highest = std::max(highest, depth);
        }
      }
    }
    return {lowest, highest};
  }
  // Expects that the bounds contain all texels that look-ups around (x, y) read.
  void ExpectBounds(double x, double y) {
    const ShadowBounds::Range<F8> bounds = BoundsAt(x, y);
    for (int i = 0; i < 8; ++i) {
      const auto [lowest, highest] = RangeAt(static_cast<float>(x) + i * 0.37f, y);
      EXPECT_LE(bounds.min[i], lowest) << x << ", " << y << ", " << i;
      EXPECT_GE(bounds.max[i], highest) << x << ", " << y << ", " << i;
    }
  }

 private:
  std::vector<float> texels_;
  ShadowBounds bounds_;
  base::ThreadTeam team_{2};
};

constexpr ShadowRegion::Rectangle kAll{0, 0, kShadowSide, kShadowSide};

TEST(ShadowBounds, ContainAllTexelsOfLookUps) {
  if (!CanRasterise()) GTEST_SKIP() << "needs AVX2";
  Map map;
  base::Noise noise(1, 2, 3);
  // Tilted squares of 40 texels, with steps between them.
  std::vector<double> slope(3 * 64 * 64);
  for (double& value : slope) value = noise.Uniform();
  map.Fill(kAll, [&](int x, int y) {
    const double* s = &slope[3 * static_cast<std::size_t>(y / 40 * 64 + x / 40)];
    return 0.5 * s[2] + 0.02 * (s[0] - 0.5) * (x % 40) + 0.02 * (s[1] - 0.5) * (y % 40);
  });
  map.UpdateBounds(kAll);
  for (int i = 0; i < 20'000; ++i) {
    const auto place = [&] { return (kShadowSide + 40) * noise.Uniform() - 20; };
    map.ExpectBounds(place(), place());
  }
}

TEST(ShadowBounds, FollowChangesOfAPart) {
  if (!CanRasterise()) GTEST_SKIP() << "needs AVX2";
  Map map;
  base::Noise noise(1, 2, 3);
  map.UpdateBounds(kAll);
  for (int i = 0; i < 200; ++i) {
    const auto start = [&] { return static_cast<int>((kShadowSide - 30) * noise.Uniform()); };
    const int x = start(), y = start();
    const ShadowRegion::Rectangle part{x, y, x + 1 + i % 29, y + 1 + i % 17};
    map.Fill(part, [&](int, int) { return noise.Uniform(); });
    map.UpdateBounds(part);
    for (int k = 0; k < 50; ++k) {
      map.ExpectBounds(x - 5 + 40 * noise.Uniform(), y - 5 + 30 * noise.Uniform());
    }
  }
}

// The upper bound of a block has a slope. A constant bound would be far above a tilted surface.
TEST(ShadowBounds, AreTightForTiltedSurfaces) {
  if (!CanRasterise()) GTEST_SKIP() << "needs AVX2";
  Map map;
  const double by_x = 1e-4, by_y = -5e-5;
  const auto depth = [&](double x, double y) { return 0.5 + by_x * x + by_y * y; };
  map.Fill(kAll, [&](int x, int y) { return depth(x + 0.5, y + 0.5); });
  map.UpdateBounds(kAll);
  for (int y = 100; y < 140; ++y) {
    const ShadowBounds::Range<F8> bounds = map.BoundsAt(200.3, y + 0.2);
    for (int i = 0; i < 8; ++i) {
      EXPECT_LT(bounds.max[i] - depth(200.3 + i * 0.37, y + 0.2),
                1.7 * std::abs(by_x) + 1.4 * std::abs(by_y) + 2e-6);
    }
  }
}

}  // namespace
}  // namespace gsv::rendering::raster
