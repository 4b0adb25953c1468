#include "gsv/rendering/cameras/exposure.h"

#include <cmath>

#include <gtest/gtest.h>

#include "gsv/base/test_within.h"
#include "gsv/rendering/testing/test_scene.h"

namespace gsv::rendering {
namespace {

double Linear(double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); }
double Encoded(double l) {
  return 255 * (l <= 0.0031308 ? 12.92 * l : 1.055 * std::pow(l, 1 / 2.4) - 0.055);
}

class ExposureTest : public testing::Test {
 protected:
  ExposureTest() { scene_.Add("robot", geometry::Box{{1, 1, 1}}, {}, Matt(1, 1, 1)); }

  model::Image Exposed(model::Parameters parameters, std::uint8_t grey, std::int64_t step = 0) {
    model::SensorDescription description;
    description.name = "eye";
    description.parameters = std::move(parameters);
    sensing::ParameterReader reader(description);
    const Exposure exposure(reader);
    EXPECT_TRUE(reader.status()) << reader.status().error().Sentence();
    auto snapshot = std::make_shared<world::Snapshot>(*scene_.Snapshot());
    snapshot->state.step = step;
    model::Image image{100, 80, 3, std::vector<std::uint8_t>(3 * 100 * 80, grey), {}};
    exposure.Apply(sensing::Sampling(snapshot, 0, 7, rays_), description, image);
    return image;
  }

  TestScene scene_;
  sensing::RaySceneCache rays_;
};

TEST_F(ExposureTest, AStopHalvesOrDoublesTheLight) {
  for (const double stops : {-2.0, -1.0, 0.5, 1.0}) {
    for (const int grey : {10, 60, 120, 180}) {
      const double light = std::min(1.0, Linear(grey / 255.0) * std::exp2(stops));
      const model::Image image = Exposed({{"exposure", stops}}, static_cast<std::uint8_t>(grey));
      EXPECT_WITHIN(image.pixels[0], Encoded(light), 0.51, "level") << stops << " " << grey;
    }
  }
}

TEST_F(ExposureTest, DefaultsLeaveImagesUnchanged) {
  EXPECT_EQ(Exposed({}, 77).pixels, std::vector<std::uint8_t>(3 * 100 * 80, 77));
  EXPECT_EQ(Exposed({{"gain", 1.0000001}}, 77).pixels, std::vector<std::uint8_t>(3 * 100 * 80, 77));
}

TEST_F(ExposureTest, VignettingGrowsWithTheSquareOfTheDistance) {
  const model::Image image = Exposed({{"vignetting", 0.6}}, 200);
  const double light = Linear(200 / 255.0);
  EXPECT_WITHIN(Brightness(image, 50, 40), 200, 1, "level");
  const double corner = 49.5 * 49.5 + 39.5 * 39.5, whole = 50 * 50 + 40 * 40;
  EXPECT_WITHIN(Brightness(image, 0, 0), Encoded(light * (1 - 0.6 * corner / whole)), 1, "level");
  EXPECT_NEAR(Brightness(image, 99, 79), Brightness(image, 0, 0), 0);
}

TEST_F(ExposureTest, NoiseHasTheGivenMeanAndDeviation) {
  const model::Image image = Exposed({{"noise.mean", 0.02}, {"noise.stddev", 0.05}}, 120);
  double sum = 0, squares = 0;
  for (const std::uint8_t v : image.pixels) sum += v, squares += double(v) * v;
  const double n = static_cast<double>(image.pixels.size());
  const double mean = sum / n, deviation = std::sqrt(squares / n - mean * mean);
  const double expected = 0.05 * 255;
  EXPECT_WITHIN_3_SIGMA(mean, 120 + 0.02 * 255, expected / std::sqrt(n));
  // Rounding to whole numbers adds 1/12 to the variance.
  EXPECT_WITHIN_3_SIGMA(deviation, std::sqrt(expected * expected + 1.0 / 12),
                        expected / std::sqrt(2 * n));
}

TEST_F(ExposureTest, NoiseDependsOnlyOnTheStep) {
  const model::Parameters noisy = {{"noise.stddev", 0.05}};
  EXPECT_EQ(Exposed(noisy, 120, 5).pixels, Exposed(noisy, 120, 5).pixels);
  EXPECT_NE(Exposed(noisy, 120, 5).pixels, Exposed(noisy, 120, 6).pixels);
}

TEST_F(ExposureTest, GainAmplifiesLightAndNoise) {
  const model::Image image =
      Exposed({{"exposure", -1.0}, {"gain", 2.0}, {"noise.stddev", 0.02}}, 120);
  double sum = 0, squares = 0;
  for (const std::uint8_t v : image.pixels) sum += v, squares += double(v) * v;
  const double n = static_cast<double>(image.pixels.size());
  EXPECT_NEAR(sum / n, 120, 0.6);
  EXPECT_NEAR(std::sqrt(squares / n - sum / n * (sum / n)), 0.04 * 255, 0.2);
}

}  // namespace
}  // namespace gsv::rendering
