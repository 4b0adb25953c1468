// Compares rendered images with the geometry of the scene.
#include <cmath>

#include <gtest/gtest.h>

#include "gsv/base/test_within.h"
#include "gsv/geometry/constants.h"
#include "gsv/rendering/testing/test_scene.h"

namespace gsv::rendering {
namespace {

using geometry::Box;
using geometry::PlanarPose;
using geometry::Pose;
using geometry::Vector3;

using geometry::kPi;

// The build compiles this file once for each back end, as RenderedImage and as OpenGlRenderedImage.
#ifndef IMAGE_SUITE
#define IMAGE_SUITE RenderedImage
#define IMAGE_BACK_END kRasteriser
#endif

RendererOptions Options() {
  RendererOptions options;
  options.back_end = BackEnd::IMAGE_BACK_END;
  return options;
}

class IMAGE_SUITE : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    auto started = Renderer::Start(Options());
    ASSERT_TRUE(started) << started.error().Sentence();
    renderer_ = *started;
  }
  static void TearDownTestSuite() { renderer_.reset(); }

  std::shared_ptr<const model::Image> Take(const CameraView& view) {
    auto image = renderer_->Draw(scene_.Snapshot(), view, std::chrono::seconds(30));
    EXPECT_TRUE(image) << image.error().Sentence();
    return image ? *image : std::make_shared<const model::Image>();
  }

  static std::shared_ptr<Renderer> renderer_;
  TestScene scene_;
};

std::shared_ptr<Renderer> IMAGE_SUITE::renderer_;

TEST_F(IMAGE_SUITE, HasTheRequestedSize) {
  for (const auto& [width, height] : {std::pair{320, 240}, {1, 1}, {17, 333}}) {
    const auto image = Take({{}, {width, height, 1, 0.1, 100}});
    EXPECT_EQ(image->width, width);
    EXPECT_EQ(image->height, height);
    EXPECT_EQ(image->channels, 3);
    EXPECT_EQ(image->pixels.size(), static_cast<std::size_t>(3) * width * height);
  }
}

TEST_F(IMAGE_SUITE, OfAnEmptyWorldIsTheBackground) {
  scene_.description().scene.background = {0.25, 0.5, 0.75, 1};
  const auto image = Take({{}, {64, 48, 1, 0.1, 100}});
  // This pixel is at the horizon. There, haze makes the sky brighter.
  const std::uint8_t* p = &image->pixels[(24 * 64 + 32) * 3];
  EXPECT_NEAR(p[0], 0.25 * 255, 45);
  EXPECT_NEAR(p[1], 0.5 * 255, 30);
  EXPECT_NEAR(p[2], 0.75 * 255, 15);
}

TEST_F(IMAGE_SUITE, ShowsAPointWhereThePinholeModelPutsIt) {
  const CameraView view{{{0.3, -0.2, 0.5}, geometry::FromRollPitchYaw({0.05, 0.1, 0.7})},
                        {320, 240, 1.047, 0.05, 100}};
  const double f = 160 / std::tan(1.047 / 2);
  for (const Vector3& p :
       {Vector3{3, 0, 0}, Vector3{4, 1.2, 0.8}, Vector3{6, -2.5, -1.5}, Vector3{2, 0.5, -0.6}}) {
    // The centre of the ball's image is not exactly the image of the ball's centre. For a radius of
    // three pixels, they are less than 0.01 pixels apart.
    scene_.Add("ball", geometry::Sphere{3 * p.x / f}, {view.world_from_camera * p, {}},
               Glowing(1, 0, 0));
    const Blob ball = FindBlob(*Take(view), 0, 10);
    EXPECT_GT(ball.pixels, 15);
    EXPECT_NEAR(ball.u, 160 - f * p.y / p.x, 0.3);
    EXPECT_NEAR(ball.v, 120 - f * p.z / p.x, 0.3);
    scene_.Remove("ball");
  }
}

TEST_F(IMAGE_SUITE, IsNotMirrored) {
  scene_.Add("left", Box{{0.4, 0.4, 0.4}}, {{3, 1, 0}, {}}, Glowing(1, 0, 0));
  scene_.Add("up", Box{{0.4, 0.4, 0.4}}, {{3, 0, 0.8}, {}}, Glowing(0, 1, 0));
  scene_.Add("behind", Box{{0.4, 0.4, 0.4}}, {{-3, 0, 0}, {}}, Glowing(0, 0, 1));
  const auto image = Take({{}, {320, 240, 1.047, 0.1, 100}});
  const Blob left = FindBlob(*image, 0), up = FindBlob(*image, 1);
  ASSERT_GT(left.pixels, 100);
  ASSERT_GT(up.pixels, 100);
  EXPECT_LT(left.u, 100);
  EXPECT_NEAR(left.v, 120, 5);
  EXPECT_LT(up.v, 80);
  EXPECT_NEAR(up.u, 160, 5);
  EXPECT_EQ(FindBlob(*image, 2).pixels, 0);
}

TEST_F(IMAGE_SUITE, NearObjectHidesTheObjectBehindIt) {
  scene_.Add("near", Box{{0.1, 1, 1}}, {{2, 0, 0}, {}}, Glowing(1, 0, 0));
  scene_.Add("far", Box{{0.1, 1, 1}}, {{3, 0, 0}, {}}, Glowing(0, 1, 0));
  const CameraView ahead{{}, {160, 120, 1, 0.1, 100}};
  auto image = Take(ahead);
  EXPECT_GT(FindBlob(*image, 0).pixels, 1000);
  EXPECT_EQ(FindBlob(*image, 1).pixels, 0);
  image = Take({PlanarPose(5, 0, 0, kPi), ahead.parameters});
  EXPECT_EQ(FindBlob(*image, 0).pixels, 0);
  EXPECT_GT(FindBlob(*image, 1).pixels, 1000);
}

TEST_F(IMAGE_SUITE, DepthsAreThoseAlongTheAxisOfTheOpaqueSurfaces) {
  scene_.Add("wall", Box{{1, 100, 3}}, {{5.5, 0, 1.5}, {}},
             Matt(1, 0, 0));  // 5 m ahead, from z = 0
  model::Material glass = Matt(0, 0, 1);
  glass.base_colour.a = 0.5;
  scene_.Add("glass", Box{{0.1, 100, 100}}, {{2, 0, 0}, {}}, glass);
  const CameraView view{{}, {65, 49, 1, 0.1, 100}};
  const auto drawn =
      renderer_->DrawWithDepth(scene_.Snapshot(), view, 16, std::chrono::seconds(30));
  ASSERT_TRUE(drawn) << drawn.error().Sentence();
  if (drawn->depth == nullptr) GTEST_SKIP() << "this processor has no AVX2";
  const DepthGrid& depth = *drawn->depth;
  EXPECT_EQ(depth.columns, 5);
  EXPECT_EQ(depth.rows, 4);
  for (int column = 0; column < depth.columns; ++column) {
    const auto at = [&](int row) {
      return depth.inverse_depth[static_cast<std::size_t>(row * depth.columns + column)];
    };
    EXPECT_NEAR(at(1), 1 / 5.0, 1e-5);  // also at the sides, where the ray is longer
    EXPECT_EQ(at(3), 0) << "below the wall";
  }
  EXPECT_EQ(drawn->image->pixels, Take(view)->pixels);
}

TEST_F(IMAGE_SUITE, ObjectsOutsideTheClippingDistancesAreNotDrawn) {
  scene_.Add("box", Box{{0.2, 1, 1}}, {{2, 0, 0}, {}}, Glowing(1, 0, 0));
  EXPECT_EQ(FindBlob(*Take({{}, {160, 120, 1, 2.5, 100}}), 0).pixels, 0);
  EXPECT_EQ(FindBlob(*Take({{}, {160, 120, 1, 0.1, 1.5}}), 0).pixels, 0);
  EXPECT_GT(FindBlob(*Take({{}, {160, 120, 1, 0.1, 100}}), 0).pixels, 1000);
}

// An image whose quarters are red (upper left), green (upper right), blue (lower left) and black
// (lower right).
std::shared_ptr<const model::Image> Quarters(int channels) {
  auto image = std::make_shared<model::Image>();
  image->width = image->height = 64;
  image->channels = channels;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const bool right = x >= 32, low = y >= 32;
      for (const bool on : {!right && !low, right && !low, !right && low}) {
        image->pixels.push_back(on ? 255 : 0);
      }
      if (channels == 4) image->pixels.push_back(right && low ? 0 : 255);
    }
  }
  return image;
}

TEST_F(IMAGE_SUITE, TextureIsUpright) {
  model::Material material = Matt(1, 1, 1);
  material.base_colour_map = Quarters(3);
  scene_.Add("board", Box{{0.1, 1, 1}}, {{2, 0, 0}, {}}, material);
  const auto image = Take({{}, {160, 120, 1, 0.1, 100}});
  const Blob red = FindBlob(*image, 0), green = FindBlob(*image, 1), blue = FindBlob(*image, 2);
  ASSERT_GT(red.pixels, 500);
  EXPECT_LT(red.u, 80);
  EXPECT_LT(red.v, 60);
  EXPECT_GT(green.u, 80);
  EXPECT_LT(green.v, 60);
  EXPECT_LT(blue.u, 80);
  EXPECT_GT(blue.v, 60);
}

// An image with two columns: black on the left, white on the right.
std::shared_ptr<const model::Image> BlackAndWhite() {
  auto image = std::make_shared<model::Image>();
  image->width = 64, image->height = 1, image->channels = 3;
  for (int x = 0; x < 64; ++x) image->pixels.insert(image->pixels.end(), 3, x < 32 ? 0 : 255);
  return image;
}

TEST_F(IMAGE_SUITE, OcclusionMapScalesAmbientLight) {
  // Light from straight above does not reach the side that the camera sees.
  model::Light above;
  above.kind = model::Light::Kind::kDirectional;
  above.direction = {0, 0, -1};
  scene_.description().lights = {above};
  model::Material material = Matt(0.8, 0.8, 0.8);
  const auto take = [&] {
    scene_.Remove("board");
    scene_.Add("board", Box{{0.1, 1, 1}}, {{2, 0, 0}, {}}, material);
    return Take({{}, {160, 120, 0.5, 0.1, 100}});
  };
  const auto plain = take();
  material.occlusion_map = BlackAndWhite();
  const auto occluded = take();
  EXPECT_GT(Brightness(*plain, 40, 60), 30);
  EXPECT_LE(Brightness(*occluded, 40, 60), 2);
  EXPECT_EQ(Brightness(*occluded, 120, 60), Brightness(*plain, 120, 60));
}

TEST_F(IMAGE_SUITE, LightMapIsReflectedAsDiffuseLight) {
  const auto take = [&](const model::Material& material) {
    scene_.Remove("board");
    scene_.Add("board", Box{{0.1, 1, 1}}, {{2, 0, 0}, {}}, material);
    return Take({{}, {160, 120, 0.5, 0.1, 100}});
  };
  model::Material material = Matt(0.5, 0.3, 0.2);
  const auto plain = take(material);
  material.light_map = BlackAndWhite();
  const auto lit = take(material);
  // A surface with this diffuse colour in white light is as bright as a surface that emits this
  // colour.
  model::Material emitting = Matt(0.5, 0.3, 0.2);
  emitting.emissive = emitting.base_colour;
  const auto expected = take(emitting);
  const std::size_t left = (60 * 160 + 40) * 3, right = (60 * 160 + 120) * 3;
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(lit->pixels[left + c], plain->pixels[left + c], 1);
    EXPECT_NEAR(lit->pixels[right + c], expected->pixels[right + c], 1);
  }
  EXPECT_GT(lit->pixels[right], lit->pixels[left] + 30);
}

TEST_F(IMAGE_SUITE, AlphaMaskShowsTheObjectBehindItsHoles) {
  model::Material material = Matt(1, 1, 1);
  material.base_colour_map = Quarters(4);
  material.alpha_mask = true;
  scene_.Add("board", Box{{0.1, 1, 1}}, {{2, 0, 0}, {}}, material);
  scene_.Add("lamp", Box{{0.1, 4, 4}}, {{4, 0, 0}, {}}, Glowing(0, 0, 1));
  // The lower right quarter of the front panel is a transparent hole. The other quarters hide the
  // panel behind it.
  const auto image = Take({{}, {160, 120, 0.5, 0.1, 100}});
  const std::uint8_t* hole = &image->pixels[(75 * 160 + 95) * 3];
  EXPECT_GT(hole[2], 150);
  EXPECT_LT(hole[0], 60);
}

TEST_F(IMAGE_SUITE, TransparentObjectIsBlendedWithItsBackground) {
  scene_.Add("pane", Box{{0.02, 1, 1}}, {{2, 0, 0}, {}}, Matt(1, 0, 0, 0.5));
  scene_.Add("wall", Box{{0.1, 8, 8}}, {{4, 0, 0}, {}}, Glowing(0, 0, 1));
  const auto image = Take({{}, {160, 120, 1, 0.1, 100}});
  const std::uint8_t* pane = &image->pixels[(60 * 160 + 80) * 3];
  const std::uint8_t* wall = &image->pixels[(5 * 160 + 5) * 3];
  EXPECT_GT(pane[0], wall[0] + 30);
  EXPECT_GT(pane[2], 60);
  EXPECT_LT(pane[2], wall[2] - 30);
}

TEST_F(IMAGE_SUITE, MirroredMeshShowsItsOutside) {
  const auto cube =
      std::make_shared<const geometry::TriangleMesh>(geometry::Tessellate(Box{{1, 1, 1}}));
  const CameraView view{{}, {160, 120, 1, 0.1, 100}};
  scene_.Add("cube", geometry::Mesh{cube, {1, 1, 1}}, {{3, 0, 0}, {}}, Matt(1, 0, 0));
  const auto plain = Take(view);
  scene_.Remove("cube");
  scene_.Add("cube", geometry::Mesh{cube, {1, -1, 1}}, {{3, 0, 0}, {}}, Matt(1, 0, 0));
  EXPECT_EQ(Take(view)->pixels, plain->pixels);
  EXPECT_GT(FindBlob(*plain, 0).pixels, 1000);
}

// The camera is 10 m high and looks down. Its 90° are 100 pixels, so a pixel is 0.2 m of the
// ground. The world's x points up in the image.
CameraView FromAbove() {
  return {{{0, 0, 10}, geometry::FromAxisAngle({0, 1, 0}, kPi / 2)}, {100, 100, kPi / 2, 0.1, 100}};
}

TEST_F(IMAGE_SUITE, ShadowPointsAwayFromTheSun) {
  model::Light sun;
  // the light is from +x, at an elevation of 45°
  sun.direction = geometry::Normalized(Vector3{-1, 0, -1});
  scene_.description().lights = {sun};
  scene_.Add("floor", Box{{20, 20, 0.1}}, {{0, 0, -0.05}, {}}, Matt(0.7, 0.7, 0.7), true);
  scene_.Add("slab", Box{{2, 2, 0.1}}, {{3, 0, 3}, {}}, Matt(0.7, 0.7, 0.7));
  const auto image = Take(FromAbove());
  // The slab at height 3 shades the ground from x = -1 to 1, which is the centre of the image.
  const int shade = Brightness(*image, 50, 50);
  const int light = Brightness(*image, 50, 85);
  EXPECT_LT(shade, light - 40);
  EXPECT_GT(shade, 40);  // the shade is not black
  scene_.description().scene.shadows = false;
  EXPECT_NEAR(Brightness(*Take(FromAbove()), 50, 50), light, 4);
}

TEST_F(IMAGE_SUITE, ShadowFollowsAnObjectThatMoved) {
  model::Light sun;
  scene_.description().lights = {sun};  // the light shines straight down
  scene_.Add("floor", Box{{20, 20, 0.1}}, {{0, 0, -0.05}, {}}, Matt(0.7, 0.7, 0.7), true);
  scene_.Add("robot", Box{{2, 2, 0.1}}, {{0, 4, 0.5}, {}}, Matt(0.7, 0.7, 0.7));
  const auto first = std::make_shared<world::Snapshot>(*scene_.Snapshot());
  const auto second = std::make_shared<world::Snapshot>(*first);
  second->state.bodies[first->layout->Find("robot")].world_from_model.position.y = -4;
  // The camera looks from the side and from a low height, so that the shadow is not hidden.
  const CameraView view{{{-9, 0, 4}, geometry::FromRollPitchYaw({0, 0.4, 0})},
                        {160, 120, 1.3, 0.1, 50}};
  const auto before = renderer_->Draw(first, view, std::chrono::seconds(30));
  const auto after = renderer_->Draw(second, view, std::chrono::seconds(30));
  ASSERT_TRUE(before && after);
  // The scene is symmetric in y, except for the direction of the light. So one image mirrors the
  // other.
  int different = 0;
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 160; ++x) {
      different += std::abs(Brightness(**before, x, y) - Brightness(**after, 159 - x, y)) > 12;
    }
  }
  EXPECT_LT(different, 160 * 120 / 200);
}

TEST_F(IMAGE_SUITE, DoesNotDependOnEarlierImages) {
  model::Light sun;
  sun.direction = geometry::Normalized(Vector3{-1, 0.5, -1});
  scene_.description().lights = {sun};
  scene_.Add("floor", Box{{20, 20, 0.1}}, {{0, 0, -0.05}, {}}, Matt(0.7, 0.7, 0.7), true);
  scene_.Add("chair", Box{{1, 1, 1}}, {{2, 2, 0.5}, {}}, Matt(0.7, 0.2, 0.2));
  scene_.Add("robot", Box{{1, 1, 1}}, {{-2, 0, 0.5}, {}}, Matt(0.2, 0.2, 0.7));
  const auto first = scene_.Snapshot();
  const auto second = std::make_shared<world::Snapshot>(*first);
  second->state.bodies[first->layout->Find("robot")].world_from_model.position = {1, -3, 0.5};
  const CameraView view = FromAbove();
  for (const auto& snapshot : {first, std::shared_ptr<const world::Snapshot>(second), first}) {
    const auto fresh = Renderer::Start(Options());
    ASSERT_TRUE(fresh);
    const auto alone = (*fresh)->Draw(snapshot, view, std::chrono::seconds(30));
    const auto after = renderer_->Draw(snapshot, view, std::chrono::seconds(30));
    ASSERT_TRUE(alone && after);
    EXPECT_EQ((*alone)->pixels, (*after)->pixels);
  }
}

// The renderer keeps the colours of still bodies. Each image must equal the image of a new
// renderer.
TEST_F(IMAGE_SUITE, OfAViewThatStaysDoesNotDependOnEarlierImages) {
  model::Light sun;
  sun.direction = geometry::Normalized(Vector3{-1, 0.5, -1});
  scene_.description().lights = {sun};
  scene_.Add("floor", Box{{20, 20, 0.1}}, {{0, 0, -0.05}, {}}, Matt(0.7, 0.7, 0.7), true);
  scene_.Add("chair", Box{{1, 1, 1}}, {{2, 2, 0.5}, {}}, Matt(0.7, 0.2, 0.2), true);
  auto glass = Matt(0.2, 0.9, 0.2);
  glass.base_colour.a = 0.5;
  scene_.Add("glass", Box{{1, 1, 1}}, {{2, -2, 0.5}, {}}, glass, true);
  scene_.Add("robot", Box{{0.6, 0.6, 1}}, {{-2, 0, 0.5}, {}}, Matt(0.2, 0.2, 0.7));
  const auto start = scene_.Snapshot();
  const int robot = start->layout->Find("robot");
  CameraView view = FromAbove();
  for (int i = 0; i < 12; ++i) {
    const auto snapshot = std::make_shared<world::Snapshot>(*start);
    const double angle = 0.7 * i;
    snapshot->state.bodies[robot].world_from_model.position = {3 * std::cos(angle),
                                                               3 * std::sin(angle), 0.5};
    if (i == 9) view.world_from_camera.position.x += 0.1;
    const auto fresh = Renderer::Start(Options());
    ASSERT_TRUE(fresh);
    const auto alone = (*fresh)->Draw(snapshot, view, std::chrono::seconds(30));
    const auto after = renderer_->Draw(snapshot, view, std::chrono::seconds(30));
    ASSERT_TRUE(alone && after);
    EXPECT_EQ((*alone)->pixels, (*after)->pixels) << i;
  }
}

TEST_F(IMAGE_SUITE, GroundBeyondTheShadowMapIsLit) {
  model::Light sun;
  sun.direction = geometry::Normalized(Vector3{1, 0, -1});
  scene_.description().lights = {sun};
  scene_.Add("ground", geometry::Plane{{0, 0, 1}, {100, 100}}, {}, Matt(0.7, 0.7, 0.7), true);
  scene_.Add("post", Box{{0.2, 0.2, 1}}, {{-3, -3, 0.5}, {}}, Matt(0.7, 0.7, 0.7), true);
  // The camera looks away from the sun. So the ground in the image is farther from the sun than the
  // post, which is behind the camera.
  const auto image = Take({{{0, 0, 2}, {}}, {160, 120, 1, 0.1, 200}});
  const int near = Brightness(*image, 80, 115), far = Brightness(*image, 80, 65);
  EXPECT_NEAR(near, far, 30);
}

TEST_F(IMAGE_SUITE, WorldWithoutLightsGetsASun) {
  scene_.description().scene.ambient = {0, 0, 0, 1};
  scene_.Add("floor", geometry::Plane{{0, 0, 1}, {100, 100}}, {}, Matt(0.7, 0.7, 0.7), true);
  const auto image = Take({{{0, 0, 1}, {}}, {160, 120, 1, 0.1, 100}});
  EXPECT_GT(Brightness(*image, 80, 110), 120);
}

TEST_F(IMAGE_SUITE, WorldLightReachesObjectsWithinItsRange) {
  model::Light lamp;
  lamp.kind = model::Light::Kind::kPoint;
  lamp.world_from_light.position = {0, 0, 1};
  lamp.range = 3;
  lamp.diffuse = {1, 0, 0, 1};
  scene_.description().lights = {lamp};
  scene_.Add("floor", Box{{20, 20, 0.1}}, {{0, 0, -0.05}, {}}, Matt(0.7, 0.7, 0.7), true);
  const auto image = Take(FromAbove());
  const Blob lit = FindBlob(*image, 0, 20);
  EXPECT_NEAR(lit.u, 50, 1);
  EXPECT_NEAR(lit.v, 50, 1);
  // The radius of the lit disc is at most the lamp's range, 3 m or 15 pixels. So the disc has at
  // most pi 15² = 707 pixels.
  EXPECT_GT(lit.pixels, 50);
  EXPECT_LT(lit.pixels, 710);
}

TEST_F(IMAGE_SUITE, SpotLightsOnlyItsCone) {
  model::Light spot;
  spot.kind = model::Light::Kind::kSpot;
  spot.world_from_light.position = {0, 0, 4};
  spot.range = 20;
  spot.diffuse = {1, 0, 0, 1};
  spot.inner_angle = 0.5, spot.outer_angle = 1.0;
  scene_.description().lights = {spot};
  scene_.Add("floor", Box{{20, 20, 0.1}}, {{0, 0, -0.05}, {}}, Matt(0.7, 0.7, 0.7), true);
  const Blob lit = FindBlob(*Take(FromAbove()), 0, 10);
  // At the outer edge of the cone, the radius is 4 tan(0.5) = 2.2 m or 11 pixels. At the inner
  // edge, it is 4 tan(0.25) = 1 m or 5 pixels.
  EXPECT_GT(lit.pixels, 3.14 * 5 * 5);
  EXPECT_LT(lit.pixels, 3.14 * 12 * 12);
}

TEST_F(IMAGE_SUITE, GroundReachesTheHorizon) {
  scene_.Add("ground", geometry::Plane{{0, 0, 1}, {20, 20}}, {}, Glowing(1, 0, 0), true);
  const auto image = Take({{{0, 0, 1}, {}}, {160, 120, 1, 0.1, 100}});
  // The ground ends 100 m away. A point there, 1 m below the camera, is f / 100 = 1.46 pixels below
  // the image's centre.
  EXPECT_NEAR(FindBlob(*image, 0).pixels / 160.0, 60 - 1.46, 0.6);
}

TEST_F(IMAGE_SUITE, DoesNotDependOnTheRestOfTheBatch) {
  scene_.Add("floor", geometry::Plane{{0, 0, 1}, {100, 100}}, {}, Matt(0.7, 0.7, 0.7), true);
  scene_.Add("ball", geometry::Sphere{0.5}, {{3, 0, 0.5}, {}}, Matt(0.2, 0.5, 0.9));
  const auto snapshot = scene_.Snapshot();
  const CameraView view{{{0, 0, 1}, {}}, {160, 120, 1, 0.1, 100}};
  const CameraView other{PlanarPose(5, 5, 1, -2), {64, 64, 2, 0.1, 30}};
  const auto alone = renderer_->Draw(snapshot, view, std::chrono::seconds(30));
  const auto batch =
      renderer_->Draw(snapshot, {other, view, other, view}, std::chrono::seconds(30));
  ASSERT_TRUE(alone && batch);
  EXPECT_EQ((*batch)[1]->pixels, (*alone)->pixels);
  EXPECT_EQ((*batch)[3]->pixels, (*alone)->pixels);
  EXPECT_EQ((*batch)[0]->pixels, (*batch)[2]->pixels);
  EXPECT_NE((*batch)[0]->pixels, (*batch)[1]->pixels);
}

// The shadows of moving objects do not depend on the other cameras in the batch.
TEST_F(IMAGE_SUITE, ShadowsOfMovingObjectsDoNotDependOnTheBatchOrItsOrder) {
  model::Light sun;
  sun.direction = geometry::Normalized(Vector3{-1, 0.3, -0.5});
  scene_.description().lights = {sun};
  scene_.Add("floor", Box{{40, 40, 0.1}}, {{0, 0, -0.05}, {}}, Matt(0.7, 0.7, 0.7), true);
  for (int i = 0; i < 30; ++i) {
    scene_.Add("robot" + std::to_string(i), Box{{0.4, 0.4, 1}}, {}, Matt(0.2, 0.5, 0.9));
  }
  const auto start = scene_.Snapshot();
  ASSERT_TRUE(renderer_->Draw(start, CameraView{}, std::chrono::seconds(30)));
  const auto moved = std::make_shared<world::Snapshot>(*start);
  for (int i = 0; i < 30; ++i) {
    const int body = start->layout->Find("robot" + std::to_string(i));
    moved->state.bodies[body].world_from_model =
        PlanarPose(8 * std::cos(i), 8 * std::sin(2.3 * i), 0.5, i);
  }
  constexpr int kViews = 8;
  std::vector<CameraView> views;
  views.reserve(kViews);
  for (int i = 0; i < kViews; ++i) {
    const int column = i % 3, row = i / 3;
    views.push_back({PlanarPose(column - 1, row - 1, 0.8, kPi / 4 * i), {120, 90, 1, 0.1, 50}});
  }
  const auto together = renderer_->Draw(moved, views, std::chrono::seconds(30));
  const auto reversed = renderer_->Draw(
      moved, std::vector<CameraView>(views.rbegin(), views.rend()), std::chrono::seconds(30));
  ASSERT_TRUE(together && reversed);
  for (std::size_t i = 0; i < views.size(); ++i) {
    const auto alone = renderer_->Draw(moved, views[i], std::chrono::seconds(30));
    ASSERT_TRUE(alone);
    EXPECT_EQ((*alone)->pixels, (*together)[i]->pixels) << i;
    EXPECT_EQ((*alone)->pixels, (*reversed)[views.size() - 1 - i]->pixels) << i;
  }
}

// A robot is in front of a grey wall. Its lamp is between them, in the centre of the image.
void BeforeAWall(TestScene& scene) {
  scene.description().scene.shadows = false;
  model::Light moon;
  moon.diffuse = {0, 0, 0, 1};
  scene.description().lights = {moon};
  scene.Add("wall", Box{{0.2, 8, 8}}, {{3, 0, 0}, {}}, Matt(0.5, 0.5, 0.5), true);
  scene.Add("robot", Box{{0.1, 0.1, 0.1}}, {{2, 0.6, 0}, {}}, Matt(0.1, 0.1, 0.1));
}

class GlowingDevice final : public world::DeviceState {
 public:
  GlowingDevice(world::DeviceMount mount, const world::Glow& glow)
      : DeviceState(std::move(mount)), glow_(glow) {}
  void AddToHash(base::Hash&) const override {}
  std::optional<world::Glow> glow() const override {
    return glow_.brightness > 0 ? std::optional(glow_) : std::nullopt;
  }

 private:
  const world::Glow glow_;
};

std::shared_ptr<const model::Image> TakeWith(Renderer& renderer, TestScene& scene, world::Glow lamp,
                                             double brightness) {
  const auto snapshot = std::make_shared<world::Snapshot>(*scene.Snapshot());
  lamp.brightness = brightness;
  lamp.colour = {1, 0, 0, 1};
  snapshot->state.devices = std::make_shared<const world::DeviceStates>(
      world::DeviceStates{std::make_shared<const GlowingDevice>(
          world::DeviceMount{"robot", "lamp", 0, {{0, -0.6, 0}, {}}}, lamp)});
  auto image =
      renderer.Draw(snapshot, CameraView{{}, {160, 120, 1, 0.05, 100}}, std::chrono::seconds(30));
  EXPECT_TRUE(image) << image.error().Sentence();
  return image ? *image : std::make_shared<const model::Image>();
}

// Returns the red channel of the wall in the middle row.
int RedAt(const model::Image& image, int x) {
  return image.pixels[static_cast<std::size_t>(3 * (60 * 160 + x))];
}

TEST_F(IMAGE_SUITE, LedGlowsAtItsMountAndLightsNothing) {
  BeforeAWall(scene_);
  world::Glow led;
  led.radius = 0.1;
  const auto dark = TakeWith(*renderer_, scene_, led, 0),
             lit = TakeWith(*renderer_, scene_, led, 1);
  EXPECT_EQ(FindBlob(*dark, 0).pixels, 0);
  const Blob ball = FindBlob(*lit, 0);
  EXPECT_WITHIN(ball.u, 80, 0.5, "pixel");
  EXPECT_WITHIN(ball.v, 60, 0.5, "pixel");
  // The ball has a diameter of 0.1 m and is 2 m away.
  const double radius = 0.1 / 2 * 80 / std::tan(0.5);
  EXPECT_WITHIN_PERCENT(ball.pixels, kPi * radius * radius, 15);
  EXPECT_EQ(RedAt(*lit, 40), RedAt(*dark, 40));
}

TEST_F(IMAGE_SUITE, LampLightsNearObjects) {
  BeforeAWall(scene_);
  world::Glow lamp;
  lamp.range = 5;
  const int dark = RedAt(*TakeWith(*renderer_, scene_, lamp, 0), 40);
  const int dim = RedAt(*TakeWith(*renderer_, scene_, lamp, 0.3), 40),
            bright = RedAt(*TakeWith(*renderer_, scene_, lamp, 1), 40);
  EXPECT_GT(dim, dark + 10);
  EXPECT_GT(bright, dim + 10);
  const auto image = TakeWith(*renderer_, scene_, lamp, 1);
  const std::uint8_t* const p = &image->pixels[3 * (60 * 160 + 40)];
  EXPECT_GT(p[0], p[1] + 40);  // the light is red
}

TEST_F(IMAGE_SUITE, LampWithAnAngleLightsAConeAlongItsAxis) {
  BeforeAWall(scene_);
  world::Glow lamp;
  lamp.range = 5;
  lamp.angle = 0.6;  // the cone lights a disc of 0.28 m on the wall, which is 0.9 m away
  lamp.radius = 0.01;
  const auto dark = TakeWith(*renderer_, scene_, lamp, 0),
             lit = TakeWith(*renderer_, scene_, lamp, 1);
  const auto pixel_at = [](double y) {
    return static_cast<int>(80 - y / 2.9 * 80 / std::tan(0.5));
  };
  EXPECT_GT(RedAt(*lit, pixel_at(0.15)), RedAt(*dark, pixel_at(0.15)) + 20);
  EXPECT_EQ(RedAt(*lit, pixel_at(0.4)), RedAt(*dark, pixel_at(0.4)));
}

}  // namespace
}  // namespace gsv::rendering
