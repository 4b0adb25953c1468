#include "gsv/rendering/lenses/lens.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "gsv/base/test_within.h"
#include "gsv/geometry/constants.h"

namespace gsv::rendering {
namespace {

using geometry::Vector2;
using geometry::Vector3;

using geometry::kPi;

// Converts from the optical frame of ROS and OpenCV (x right, y down, z along the view) to the
// camera frame.
Vector3 FromOptical(double x, double y, double z) { return {z, -x, -y}; }

CameraParameters Camera(int width = 640, int height = 480, double fov = 1.05) {
  CameraParameters camera;
  camera.width = width, camera.height = height, camera.horizontal_fov = fov;
  return camera;
}

Lens Distorted() {
  return {Camera(), {500, 510, 320, 240, 0}, {-0.28, 0.07, 0.002, 0.0011, -0.0004}};
}

TEST(Lens, PlainPinholeProjectsLikeTheCamera) {
  const Lens lens(Camera(640, 480, kPi / 2));
  EXPECT_TRUE(lens.is_plain());
  const auto at = lens.Project({2, -0.5, 0.25});
  ASSERT_TRUE(at);
  EXPECT_WITHIN(at->x, 320 + 320 * 0.25, 1e-9, "pixel");
  EXPECT_WITHIN(at->y, 240 - 320 * 0.125, 1e-9, "pixel");
  EXPECT_FALSE(lens.Project({-1, 0, 0}));
}

TEST(Lens, DistortionEqualsThePublishedEquations) {
  const Lens lens = Distorted();
  EXPECT_FALSE(lens.is_plain());
  const struct {
    Vector3 point;
    Vector2 expected;  // computed independently of this program
  } cases[] = {
      {FromOptical(0.3, -0.2, 1.0), {464.59010909999995, 141.73397581199998}},
      {FromOptical(-1.2, 0.9, 2.5), {101.63808512000003, 407.1937448832}},
      {FromOptical(0.05, 0.6, 1.1), {340.93135020350377, 497.10118310245616}},
  };
  for (const auto& c : cases) {
    const auto at = lens.Project(c.point);
    ASSERT_TRUE(at);
    EXPECT_WITHIN(at->x, c.expected.x, 1e-9, "pixel");
    EXPECT_WITHIN(at->y, c.expected.y, 1e-9, "pixel");
  }
}

TEST(Lens, RayAtInvertsProject) {
  WideView odd{WideView::Function::kSine, 1.3, 2.1, 0, 0.9, 1.2};
  const Lens lenses[] = {
      Lens(Camera()),
      Distorted(),
      {Camera(), {700, 650, 300, 260, 12}, {0.1, -0.02, 0, 0.002, 0.001, {0.45, 0.56}}},
      *Lens::Wide(Camera(), *WideViewNamed("equidistant"), kPi),
      *Lens::Wide(Camera(), *WideViewNamed("stereographic"), 3),
      *Lens::Wide(Camera(), *WideViewNamed("solid_angle"), 2.5),
      *Lens::Wide(Camera(), *WideViewNamed("orthographic"), 2.5),
      *Lens::Wide(Camera(), odd, 0),
  };
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> us(0, 640), vs(0, 480), far(0.1, 10);
  for (const Lens& lens : lenses) {
    int seen = 0;
    for (int i = 0; i < 500; ++i) {
      const double u = us(random), v = vs(random);
      const auto ray = lens.RayAt(u, v);
      if (!ray) continue;
      ++seen;
      EXPECT_NEAR(Norm(*ray), 1, 1e-12);
      const auto back = lens.Project(far(random) * *ray);
      ASSERT_TRUE(back) << u << " " << v;
      EXPECT_WITHIN(back->x, u, 1e-6, "pixel");
      EXPECT_WITHIN(back->y, v, 1e-6, "pixel");
    }
    EXPECT_GT(seen, 150);
  }
}

TEST(Lens, StrongBarrelDistortionShowsNoPointTwice) {
  // x (1 - 0.5 x²) has its maximum, 0.544, at x = √(2/3).
  const Lens lens(Camera(), {400, 400, 320, 240, 0}, {-0.5});
  const double widest = std::sqrt(2.0 / 3);
  EXPECT_TRUE(lens.Project({1, -0.99 * widest, 0}));
  EXPECT_FALSE(lens.Project({1, -1.01 * widest, 0}));
  EXPECT_TRUE(lens.RayAt(320 + 400 * 0.54, 240));
  EXPECT_FALSE(lens.RayAt(320 + 400 * 0.55, 240));
}

TEST(Lens, WideViewsImageAnglesByTheirFunction) {
  const double fov = 3;
  const struct {
    const char* type;
    double (*radius)(double angle);
  } cases[] = {
      {"gnomonical", [](double a) { return std::tan(a); }},
      {"stereographic", [](double a) { return 2 * std::tan(a / 2); }},
      {"equidistant", [](double a) { return a; }},
      {"equisolid_angle", [](double a) { return 2 * std::sin(a / 2); }},
      {"solid_angle", [](double a) { return 2 * std::sin(a / 2); }},
      {"orthographic", [](double a) { return std::sin(a); }},
  };
  for (const auto& c : cases) {
    const auto view = WideViewNamed(c.type);
    ASSERT_TRUE(view);
    const auto lens = Lens::Wide(Camera(), *view, fov);
    ASSERT_TRUE(lens) << c.type;
    for (const double angle : {0.0, 0.3, 1.0, fov / 2}) {
      // The point is to the right, which is -y.
      const auto at = lens->Project({std::cos(angle), -std::sin(angle), 0});
      ASSERT_TRUE(at) << c.type;
      EXPECT_WITHIN(at->x, 320 + 320 * c.radius(angle) / c.radius(fov / 2), 1e-9, "pixel")
          << c.type;
      EXPECT_WITHIN(at->y, 240, 1e-9, "pixel") << c.type;
    }
  }
}

TEST(Lens, ShowsNothingBeyondTheCutoffAngle) {
  WideView view = *WideViewNamed("equidistant");
  view.cutoff_angle = 1;
  const auto lens = Lens::Wide(Camera(), view, kPi);
  ASSERT_TRUE(lens);
  EXPECT_TRUE(lens->Project({std::cos(0.99), std::sin(0.99), 0}));
  EXPECT_FALSE(lens->Project({std::cos(1.01), std::sin(1.01), 0}));
  EXPECT_TRUE(lens->RayAt(320 + 320 * 0.99 / (kPi / 2), 240));
  EXPECT_FALSE(lens->RayAt(320 + 320 * 1.01 / (kPi / 2), 240));
}

TEST(Lens, RejectsInvalidParameters) {
  EXPECT_FALSE(WideViewNamed("fish"));
  EXPECT_FALSE(Lens::Wide(Camera(), *WideViewNamed("gnomonical"), 3.3));
  EXPECT_FALSE(Lens::Wide(Camera(), *WideViewNamed("orthographic"), 4));
}

}  // namespace
}  // namespace gsv::rendering
