#include "gsv/rendering/images/depth_segment.h"

#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include "gsv/rendering/images/jpeg.h"

namespace gsv::rendering {
namespace {

// Returns the inverse depths of a segment. This decoder shares no code with the encoder.
std::vector<float> Decode(const std::vector<std::uint8_t>& bytes, std::size_t columns,
                          std::size_t samples) {
  std::size_t at = sizeof kDepthIdentifier + 6;
  float scale = 0;
  std::memcpy(&scale, &bytes[at], sizeof scale);
  at += sizeof scale;
  bool is_high = false;
  const auto group = [&] {
    const int half = is_high ? bytes.at(at++) >> 4 : bytes.at(at) & 15;
    is_high = !is_high;
    return half;
  };
  std::vector<std::uint16_t> numbers(samples);
  for (std::size_t i = 0; i < samples; ++i) {
    unsigned zigzag = 0;
    for (int shift = 0;; shift += 3) {
      const int half = group();
      zigzag |= static_cast<unsigned>(half & 7) << shift;
      if (half < 8) break;
    }
    const auto difference = static_cast<std::uint16_t>((zigzag >> 1) ^ -(zigzag & 1));
    const bool has_left = i % columns > 0, has_above = i >= columns;
    const int left = has_left ? numbers[i - 1] : 0, above = has_above ? numbers[i - columns] : 0;
    const int above_left = has_left && has_above ? numbers[i - columns - 1] : 0;
    numbers[i] = static_cast<std::uint16_t>(left + above - above_left + difference);
  }
  std::vector<float> inverse;
  for (const std::uint16_t number : numbers) {
    inverse.push_back(scale > 0 ? static_cast<float>(number) / scale : 0);
  }
  return inverse;
}

// A floor with a block on it, below a sky.
DepthGrid Example(int width, int height, int spacing) {
  return MakeDepthGrid(width, height, spacing, [&](int x, int y) {
    if (x > width / 3 && x < width / 2 && y > height / 3) return 0.5f;
    return y < height / 2 ? 0.0f : static_cast<float>(y - height / 2) / static_cast<float>(height);
  });
}

TEST(DepthGrid, SamplesContainTheBordersOfTheImage) {
  EXPECT_EQ(DepthSamples(1, 8), 1);
  EXPECT_EQ(DepthSamples(8, 8), 2);
  EXPECT_EQ(DepthSamples(9, 8), 2);
  EXPECT_EQ(DepthSamples(10, 8), 3);
  const DepthGrid grid =
      MakeDepthGrid(10, 3, 8, [](int x, int y) { return static_cast<float>(10 * y + x); });
  EXPECT_EQ(grid.inverse_depth, (std::vector<float>{0, 8, 9, 20, 28, 29}));
}

TEST(DepthSegment, HasTheDepthsWithinHalfANumber) {
  const DepthGrid grid = Example(640, 360, 8);
  const auto bytes = EncodeDepth(grid);
  EXPECT_STREQ(reinterpret_cast<const char*>(bytes.data()), "GSV-depth");
  EXPECT_EQ(bytes[10] + 256 * bytes[11], 640);
  EXPECT_EQ(bytes[12] + 256 * bytes[13], 360);
  EXPECT_EQ(bytes[14] + 256 * bytes[15], 8);
  const auto inverse =
      Decode(bytes, static_cast<std::size_t>(grid.columns), grid.inverse_depth.size());
  for (std::size_t i = 0; i < inverse.size(); ++i) {
    EXPECT_NEAR(inverse[i], grid.inverse_depth[i], 0.5 * 0.5 / 65535 * 1.01) << i;
  }
  // The inverse depth of a plane equals its prediction, except for rounding. So most codes are a
  // single group of four bits.
  EXPECT_LT(bytes.size(), grid.inverse_depth.size());
}

TEST(DepthSegment, OfTheSkyHasNoDepth) {
  const DepthGrid grid = MakeDepthGrid(64, 48, 8, [](int, int) { return 0.0f; });
  const auto bytes = EncodeDepth(grid);
  for (const float inverse : Decode(bytes, 9, grid.inverse_depth.size())) EXPECT_EQ(inverse, 0);
}

TEST(DepthSegment, FitsInAJpegForAnyDepths) {
  std::uint32_t random = 1;
  const DepthGrid grid = MakeDepthGrid(kMaxDepthSamples, 1, 1, [&](int, int) {
    random = 1664525 * random + 1013904223;
    return static_cast<float>(random >> 8);
  });
  EXPECT_LE(EncodeDepth(grid).size(), 65'533u);
  const auto inverse = Decode(EncodeDepth(grid), kMaxDepthSamples, kMaxDepthSamples);
  for (std::size_t i = 0; i < inverse.size(); ++i) {
    EXPECT_NEAR(inverse[i], grid.inverse_depth[i], 0x1p24 / 65535);
  }
}

TEST(DepthSegment, FollowsTheFirstSegmentOfAJpegAndTheRestStays) {
  model::Image image;
  image.width = image.height = 16;
  image.pixels.assign(3 * 16 * 16, 90);
  const auto plain = EncodeJpeg(image, 80);
  ASSERT_TRUE(plain);
  auto jpeg = *plain;
  const DepthGrid grid = Example(16, 16, 4);
  InsertDepth(grid, jpeg);
  const std::size_t size = 4 + EncodeDepth(grid).size();
  ASSERT_EQ(jpeg.size(), plain->size() + size);
  const std::size_t begin = 4 + static_cast<std::size_t>(256 * jpeg[4] + jpeg[5]);
  EXPECT_EQ(jpeg[begin], 0xff);
  EXPECT_EQ(jpeg[begin + 1], 0xe9);
  EXPECT_EQ(256u * jpeg[begin + 2] + jpeg[begin + 3], size - 2);
  jpeg.erase(jpeg.begin() + static_cast<std::ptrdiff_t>(begin),
             jpeg.begin() + static_cast<std::ptrdiff_t>(begin + size));
  EXPECT_EQ(jpeg, *plain);
}

}  // namespace
}  // namespace gsv::rendering
