// Tests that objects appear in an image where the equations of the lens predict them.
#include "gsv/rendering/lenses/lens_map.h"

#include <algorithm>
#include <cmath>
#include <ostream>
#include <vector>

#include <gtest/gtest.h>

#include "gsv/base/test_table.h"
#include "gsv/base/test_within.h"
#include "gsv/geometry/constants.h"
#include "gsv/rendering/cameras/optics.h"
#include "gsv/rendering/lenses/light_encoding.h"
#include "gsv/rendering/testing/test_scene.h"

namespace gsv::rendering {
namespace {

using geometry::Vector2;
using geometry::Vector3;

using geometry::kPi;

struct LensCase {
  const char* name;
  model::Parameters parameters;
  double widest;  // largest angle from the view axis, rad

  friend void PrintTo(const LensCase& lens, std::ostream* out) { *out << lens.name; }
};

std::vector<LensCase> Cases() {
  const std::string equidistant = "equidistant", stereographic = "stereographic";
  return {
      {"pinhole", {{"horizontal_fov", 1.05}}, 0.5},
      {"distorted",
       {{"horizontal_fov", 1.05},
        {"distortion.k1", -0.28},
        {"distortion.k2", 0.07},
        {"distortion.p1", 0.0011},
        {"distortion.p2", -0.0004}},
       0.5},
      {"cushion", {{"horizontal_fov", 1.05}, {"distortion.k1", 0.2}}, 0.45},
      {"intrinsics",
       {{"lens.intrinsics.fx", 600.0},
        {"lens.intrinsics.fy", 640.0},
        {"lens.intrinsics.cx", 300.0},
        {"lens.intrinsics.cy", 260.0}},
       0.3},
      {"fisheye", {{"horizontal_fov", kPi}, {"lens.type", equidistant}}, 1.5},
      {"all round",
       {{"horizontal_fov", 5.0}, {"lens.type", stereographic}, {"lens.cutoff_angle", kPi}},
       2.0},
  };
}

class LensImage : public testing::TestWithParam<LensCase> {
 protected:
  Optics Read() {
    model::SensorDescription description;
    description.parameters = GetParam().parameters;
    description.parameters["image.width"] = 640.0;
    description.parameters["image.height"] = 480.0;
    sensing::ParameterReader reader(description);
    Optics optics = Optics::Read(reader);
    EXPECT_TRUE(reader.status()) << reader.status().error().Sentence();
    return optics;
  }

  void SetUp() override {
    if (!renderer_) GTEST_SKIP() << renderer_.error().Sentence();
  }

  base::Result<std::shared_ptr<Renderer>> renderer_ = Renderer::Start();
};

// Returns the centre of a ball's image, computed from the rays to the ball's rim. This is not the
// image of the ball's centre.
Vector2 MiddleOfBall(const Lens& lens, const Vector3& centre, double radius) {
  const double sine = radius / Norm(centre);
  const Vector3 along = Normalized(centre);
  const Vector3 side =
      Normalized(Cross(along, std::abs(along.z) < 0.9 ? Vector3{0, 0, 1} : Vector3{1, 0, 0}));
  const Vector3 other = Cross(along, side);
  constexpr int kCorners = 720;  // the corners of the polygon whose centroid is computed
  std::vector<Vector2> rim;
  for (int i = 0; i < kCorners; ++i) {
    const double a = 2 * kPi * i / kCorners;
    const auto at = lens.Project(std::sqrt(1 - sine * sine) * along +
                                 sine * (std::cos(a) * side + std::sin(a) * other));
    EXPECT_TRUE(at);
    if (at) rim.push_back(*at);
  }
  double area = 0, u = 0, v = 0;
  for (std::size_t i = 0; i < rim.size(); ++i) {
    const Vector2 &a = rim[i], &b = rim[(i + 1) % rim.size()];
    const double piece = a.x * b.y - b.x * a.y;
    area += piece, u += piece * (a.x + b.x), v += piece * (a.y + b.y);
  }
  return {u / (3 * area), v / (3 * area)};
}

// The centre of the image of a glowing red object. Each pixel is weighted by the fraction that the
// object covers. This fraction is computed from the light of the object and from an image without
// the object. (In that image, haze is brighter towards the horizon.)
Blob Covered(const model::Image& image, const model::Image& without) {
  const float full = LightOf(*std::max_element(image.pixels.begin(), image.pixels.end()));
  Blob blob;
  double whole = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const std::size_t red = 3 * (static_cast<std::size_t>(y) * image.width + x);
      if (image.pixels[red] <= without.pixels[red]) continue;
      const float behind = LightOf(without.pixels[red]);
      const double part = (LightOf(image.pixels[red]) - behind) / (full - behind);
      ++blob.pixels;
      whole += part;
      blob.u += part * (x + 0.5), blob.v += part * (y + 0.5);
    }
  }
  blob.u /= whole, blob.v /= whole;
  return blob;
}

// The measured position of a ball's edge has an error of up to a pixel. So the test averages over
// balls of several sizes.
TEST_P(LensImage, ShowsObjectsWhereTheEquationsPutThem) {
  const Optics optics = Read();
  const auto is_inside = [](const Vector2& at) {
    return at.x > 40 && at.x < 600 && at.y > 40 && at.y < 440;
  };
  int seen = 0;
  Vector2 squares;
  base::testing::Table table("lens");
  TestScene nothing;
  nothing.description().scene.background = {0, 0, 0, 1};
  const auto empty = optics.Draw(**renderer_, nothing.Snapshot(), {});
  ASSERT_TRUE(empty) << empty.error().Sentence();
  for (const double angle : {0.0, 0.3, 0.6, 0.95}) {
    for (const double round : {0.2, 1.7, 3.9, 5.1}) {
      const double off = angle * GetParam().widest;
      const Vector3 centre = 4 * Vector3{std::cos(off), std::sin(off) * std::cos(round),
                                         std::sin(off) * std::sin(round)};
      const auto middle = optics.lens().Project(centre);
      if (!middle || !is_inside(*middle)) continue;
      ++seen;
      Vector2 error;
      constexpr double kSizes[] = {0.16, 0.18, 0.205, 0.24};
      for (const double size : kSizes) {
        const double radius = size * std::max(0.5, GetParam().widest);
        TestScene scene;
        scene.description().scene.background = {0, 0, 0, 1};
        scene.Add("ball", geometry::Sphere{radius}, {centre, {}}, Glowing(1, 0, 0));
        const auto image = optics.Draw(**renderer_, scene.Snapshot(), {});
        ASSERT_TRUE(image) << image.error().Sentence();
        ASSERT_EQ((*image)->width, 640);
        const Blob ball = Covered(**image, **empty);
        EXPECT_GT(ball.pixels, 50);
        const Vector2 expected = MiddleOfBall(optics.lens(), centre, radius);
        error = error + (1.0 / std::size(kSizes)) * (Vector2{ball.u, ball.v} - expected);
      }
      EXPECT_WITHIN(error.x, 0, 0.1, "pixel") << off << " " << round;
      EXPECT_WITHIN(error.y, 0, 0.1, "pixel") << off << " " << round;
      table.Row({off, error.x, error.y});
      squares = squares + Vector2{error.x * error.x, error.y * error.y};
    }
  }
  EXPECT_GE(seen, 8);
  EXPECT_WITHIN(std::sqrt(squares.x / seen), 0, 0.05, "pixel root mean square");
  EXPECT_WITHIN(std::sqrt(squares.y / seen), 0, 0.05, "pixel root mean square");
}

TEST_P(LensImage, MeasuresTheDepthOfAWall) {
  const Optics optics = Read();
  TestScene scene;
  scene.Add("wall", geometry::Box{{1, 2000, 2000}}, {{5.5, 0, 0}, {}}, Matt(1, 1, 1));
  const auto truth = optics.DrawGroundTruth(**renderer_, scene.Snapshot(), {});
  ASSERT_TRUE(truth) << truth.error().Sentence();
  const int wall = 0;
  int seen = 0;
  double worst = 0;  // the largest error along the ray
  for (int y = 0; y < 480; ++y) {
    for (int x = 0; x < 640; ++x) {
      const std::size_t at = static_cast<std::size_t>(y) * 640 + static_cast<std::size_t>(x);
      const auto ray = optics.lens().RayAt(x + 0.5, y + 0.5);
      if (!ray || ray->x < 0.15) continue;
      ASSERT_EQ((*truth)->body[at], wall) << x << " " << y;
      const double error = std::abs((*truth)->depth[at] - 5) * ray->x;
      if (!(error <= worst)) worst = error;
      ++seen;
    }
  }
  EXPECT_WITHIN(worst, 0, 1e-4, "m");
  EXPECT_GT(seen, 20'000);
}

INSTANTIATE_TEST_SUITE_P(Lenses, LensImage, testing::ValuesIn(Cases()), [](const auto& tested) {
  std::string name = tested.param.name;
  std::erase(name, ' ');
  return name;
});

TEST_P(LensImage, MapReturnsTheRayOfEachPixel) {
  const Optics optics = Read();
  for (std::size_t i = 0; i < 640 * 480; i += 97) {
    const std::size_t column = i % 640, row = i / 640;
    const auto expected =
        optics.lens().RayAt(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5);
    const auto ray = optics.RayOfPixel(i);
    ASSERT_EQ(ray.has_value(), expected.has_value()) << i;
    if (ray) {
      ASSERT_LT(Norm(*ray - *expected), 1e-6) << i;
    }
  }
}

TEST(Optics, RejectsTooLargeImagesThroughALens) {
  model::SensorDescription description;
  description.parameters = {
      {"image.width", 4096.0}, {"image.height", 1024.0}, {"distortion.k1", -0.1}};
  sensing::ParameterReader fits(description);
  (void)Optics::Read(fits);
  EXPECT_TRUE(fits.status());
  description.parameters["image.height"] = 1025.0;
  sensing::ParameterReader too_large(description);
  (void)Optics::Read(too_large);
  ASSERT_FALSE(too_large.status());
  EXPECT_NE(too_large.status().error().message.find("4096 by 1025"), std::string::npos);
  // A camera without a lens takes an image without resampling.
  description.parameters.erase("distortion.k1");
  sensing::ParameterReader plain(description);
  (void)Optics::Read(plain);
  EXPECT_TRUE(plain.status());
}

TEST(LensMap, RendersOnlyTheFacesThatTheLensSees) {
  EXPECT_EQ(LensMap(Lens(CameraParameters{}), {}).Views({}).size(), 1u);
  const auto half = Lens::Wide({}, *WideViewNamed("equidistant"), kPi);
  ASSERT_TRUE(half);
  // The map uses all faces of the cube except the face behind the camera.
  EXPECT_EQ(LensMap(*half, {}).Views({}).size(), 5u);
}

TEST(LensMap, IsBlackWhereTheLensShowsNothing) {
  WideView narrow = *WideViewNamed("equidistant");
  narrow.cutoff_angle = 0.5;
  const auto lens = Lens::Wide({}, narrow, 2);
  ASSERT_TRUE(lens);
  const LensMap map(*lens, {});
  const CameraParameters face = map.Views({}).front().parameters;
  const auto white = std::make_shared<const model::Image>(model::Image{
      face.width,
      face.height,
      3,
      std::vector<std::uint8_t>(
          3 * static_cast<std::size_t>(face.width) * static_cast<std::size_t>(face.height), 255),
      {}});
  const std::vector<std::shared_ptr<const model::Image>> faces{white};
  const model::Image joined = map.Join(faces);
  EXPECT_EQ(Brightness(joined, 160, 120), 255);
  EXPECT_EQ(Brightness(joined, 160 + 75, 120), 255);  // 0.5 rad are 80 pixels
  EXPECT_EQ(Brightness(joined, 160 + 85, 120), 0);
  EXPECT_EQ(Brightness(joined, 0, 0), 0);
}

}  // namespace
}  // namespace gsv::rendering
