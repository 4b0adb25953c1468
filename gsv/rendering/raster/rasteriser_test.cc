#include "gsv/rendering/raster/rasteriser.h"

#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "gsv/rendering/raster/raster_batch_renderer.h"
#include "gsv/rendering/raster/raster_mesh.h"
#include "gsv/rendering/testing/test_scene.h"

namespace gsv::rendering {
namespace {

constexpr std::chrono::seconds kDrawTimeout{30};

std::shared_ptr<Renderer> StartRenderer(BackEnd back_end) {
  RendererOptions options;
  options.back_end = back_end;
  auto started = Renderer::Start(options);
  EXPECT_TRUE(started) << started.error().Sentence();
  return started ? *started : nullptr;
}

// The camera is in a closed room of many triangles: a gap between two of them would show the sky.
TEST(Rasteriser, LeavesNoGapsBetweenTriangles) {
  TestScene scene;
  auto mesh = std::make_shared<geometry::TriangleMesh>();
  constexpr int kSlices = 90, kStacks = 70;
  for (int stack = 0; stack <= kStacks; ++stack) {
    for (int slice = 0; slice <= kSlices; ++slice) {
      const double a = 2 * std::numbers::pi * (slice % kSlices) / kSlices;
      const double b = std::numbers::pi * stack / kStacks;
      mesh->positions.push_back(
          {3 * std::sin(b) * std::cos(a), 2 * std::sin(b) * std::sin(a), 1.5 * std::cos(b)});
    }
  }
  for (std::uint32_t stack = 0; stack < kStacks; ++stack) {
    for (std::uint32_t slice = 0; slice < kSlices; ++slice) {
      const std::uint32_t i = stack * (kSlices + 1) + slice, below = i + kSlices + 1;
      mesh->triangles.push_back({i, i + 1, below});
      mesh->triangles.push_back({i + 1, below + 1, below});
    }
  }
  mesh->parts.push_back({"", 0, static_cast<std::uint32_t>(mesh->triangles.size()), 0});
  model::Material material = Glowing(0, 1, 0);
  material.double_sided = true;
  scene.description().scene.background = {1, 0, 0, 1};
  scene.Add("room", geometry::Mesh{mesh, {1, 1, 1}}, {}, material);
  const auto renderer = StartRenderer(BackEnd::kRasteriser);
  for (int i = 0; i < 12; ++i) {
    const CameraView view{{{0.3 * std::cos(i), 0.2 * std::sin(i), 0.1},
                           geometry::FromRollPitchYaw({0.2 * i, 0.3 * i, 0.7 * i})},
                          {320, 240, 1.5, 0.01, 100}};
    const auto image = renderer->Draw(scene.Snapshot(), view, kDrawTimeout);
    ASSERT_TRUE(image);
    for (std::size_t p = 0; p < (*image)->pixels.size(); p += 3) {
      ASSERT_LT((*image)->pixels[p], 128) << "view " << i << ", pixel " << p / 3;
    }
  }
}

// The wall beside the camera extends from behind the camera, through the near plane, to beyond the
// far plane.
TEST(Rasteriser, DrawsTrianglesThatReachBehindTheCamera) {
  TestScene scene;
  scene.Add("wall", geometry::Box{{400, 0.1, 2}}, {{0, -1, 0}, {}}, Glowing(0, 1, 0));
  const auto renderer = StartRenderer(BackEnd::kRasteriser);
  const auto image = renderer->Draw(
      scene.Snapshot(), CameraView{{}, {200, 100, std::numbers::pi / 2, 0.1, 150}}, kDrawTimeout);
  ASSERT_TRUE(image);
  // The focal length is 100 pixels. The wall is 0.95 m to the right. At the far plane, 150 m away,
  // it is 0.6 pixels to the right of the middle column. In column u, its upper and lower edges are
  // (u - 100) / 0.95 pixels from the middle row.
  for (int u = 105; u < 200; ++u) {
    const double half = (u + 0.5 - 100) / 0.95;
    int green = 0;
    for (int v = 0; v < 100; ++v) green += (*image)->pixels[3 * (v * 200 + u) + 1] > 200;
    EXPECT_NEAR(green, std::min(100.0, 2 * half), 2.1) << u;
  }
}

TEST(RasterMesh, CoarserLevelsDisplaceVerticesByAtMostTheirCell) {
  auto mesh = geometry::Tessellate(geometry::Sphere{1});
  MeshArrays arrays;
  for (const auto& p : mesh.positions) {
    for (const double value : {p.x, p.y, p.z, p.x, p.y, p.z, 0.0, 0.0, 1.0}) {
      arrays.vertices.push_back(static_cast<float>(value));
    }
  }
  for (const auto& t : mesh.triangles)
    arrays.indices.insert(arrays.indices.end(), t.begin(), t.end());
  const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
  arrays.chunks.push_back({0, count, 0, {{-1, -1, -1}, {1, 1, 1}}});
  const auto made = raster::MakeRasterMesh(arrays);
  const auto& raster_mesh = static_cast<const raster::RasterMesh&>(*made);
  ASSERT_EQ(raster_mesh.levels.size(), 1u);
  const auto& levels = raster_mesh.levels[0];
  ASSERT_GT(levels.size(), 2u);
  EXPECT_EQ(levels[0].cell, 0);
  EXPECT_GE(levels[0].triangle_count, count);
  for (std::size_t l = 1; l < levels.size(); ++l) {
    EXPECT_GT(levels[l].cell, levels[l - 1].cell);
    EXPECT_LT(levels[l].triangle_count, levels[l - 1].triangle_count);
    for (std::uint32_t i = 0; i < levels[l].vertex_count; ++i) {
      const std::uint32_t v = levels[l].first_vertex + i;
      const double radius = std::hypot(raster_mesh.x[v], raster_mesh.y[v], raster_mesh.z[v]);
      // Each level is made from the next finer level, so the displacements of a vertex add up. The
      // cells of a level are at least 1.5 times as large as those of the next finer level. So the
      // sum is at most three diagonals of a cell.
      EXPECT_NEAR(radius, 1, std::sqrt(3.0) * 3 * levels[l].cell);
    }
  }
}

TEST(BackEnds, DrawSimilarImages) {
  TestScene scene;
  model::Light sun;
  sun.direction = geometry::Normalized(geometry::Vector3{-1, 0.4, -0.8});
  model::Light lamp;
  lamp.kind = model::Light::Kind::kPoint;
  lamp.world_from_light.position = {2, 1, 2};
  lamp.range = 6;
  scene.description().lights = {sun, lamp};
  auto checked = std::make_shared<model::Image>();
  checked->width = checked->height = 64;
  for (int i = 0; i < 64 * 64; ++i) {
    const std::uint8_t shade = (i / 8 + i / 64 / 8) % 2 == 0 ? 230 : 90;
    checked->pixels.insert(checked->pixels.end(), {shade, shade, shade});
  }
  model::Material tiles = Matt(0.9, 0.8, 0.7);
  tiles.base_colour_map = checked;
  model::Material metal;
  metal.base_colour = {0.8, 0.6, 0.3, 1};
  metal.metalness = 0.8, metal.roughness = 0.3;
  scene.Add("floor", geometry::Box{{20, 20, 0.1}}, {{0, 0, -0.05}, {}}, tiles, true);
  scene.Add("ball", geometry::Sphere{0.5}, {{3, 0.5, 0.5}, {}}, metal);
  scene.Add("post", geometry::Cylinder{0.2, 1.5}, {{4, -0.8, 0.75}, {}}, Matt(0.7, 0.1, 0.1));
  scene.Add("pane", geometry::Box{{0.02, 1, 1}}, {{2.5, -0.8, 0.5}, {}}, Matt(0.2, 0.4, 0.9, 0.4));
  const CameraView view{{{0, 0, 1}, geometry::FromRollPitchYaw({0, 0.2, 0})},
                        {320, 240, 1.1, 0.05, 60}};
  const auto snapshot = scene.Snapshot();
  const auto ours = StartRenderer(BackEnd::kRasteriser)->Draw(snapshot, view, kDrawTimeout);
  const auto theirs = StartRenderer(BackEnd::kOpenGl)->Draw(snapshot, view, kDrawTimeout);
  ASSERT_TRUE(ours && theirs);
  double sum = 0;
  int far_off = 0;
  for (std::size_t i = 0; i < (*ours)->pixels.size(); ++i) {
    const int difference = std::abs((*ours)->pixels[i] - (*theirs)->pixels[i]);
    sum += difference;
    far_off += difference > 40;
  }
  EXPECT_LT(sum / static_cast<double>((*ours)->pixels.size()), 3);
  EXPECT_LT(far_off, static_cast<int>((*ours)->pixels.size() / 100));
}

// The renderer draws eight or sixteen pixels at a time. A row of 203 pixels is not a multiple of eight.
TEST(RasterBatchRenderer, DrawsEqualImagesByOneAndBySeveralThreads) {
  TestScene scene;
  scene.Add("floor", geometry::Box{{20, 20, 0.1}}, {{0, 0, -0.05}, {}}, Matt(0.9, 0.8, 0.7), true);
  scene.Add("ball", geometry::Sphere{0.5}, {{3, 0.5, 0.5}, {}}, Matt(0.7, 0.1, 0.1));
  const auto snapshot = scene.Snapshot();
  raster::RasterBatchRenderer renderer(4);
  for (int i = 0; i < 100; ++i) {
    // Another pitch each time, so that no pixels of the last image are kept.
    const CameraView view{{{0, 0, 1}, geometry::FromRollPitchYaw({0, 0.2 + 0.001 * i, 0})},
                          {203, 90, 1.1, 0.05, 60}};
    const auto together = renderer.Draw(*snapshot, {view});     // by four threads
    const auto apart = renderer.Draw(*snapshot, {view, view});  // each by one thread
    ASSERT_TRUE(together && apart);
    ASSERT_EQ(together->at(0)->pixels, apart->at(1)->pixels) << i;
  }
}

// Widths that are and are not multiples of eight and sixteen, textures seen at a grazing angle, a
// normal map, a mask, a transparent pane, curved and flat surfaces, lamps and shadows.
TEST(RasterBatchRenderer, DrawsEqualImagesWithEightAndWithSixteenLanes) {
  if (!raster::HasSixteenLanes()) GTEST_SKIP() << "this processor has no AVX-512";
  TestScene scene;
  model::Light sun, lamp, spot;
  sun.direction = geometry::Normalized(geometry::Vector3{-1, 0.4, -0.8});
  lamp.kind = model::Light::Kind::kPoint;
  lamp.world_from_light.position = {2, 1, 2};
  lamp.range = 4;
  spot.kind = model::Light::Kind::kSpot;
  spot.world_from_light.position = {4, -2, 3};
  spot.range = 6;
  scene.description().lights = {sun, lamp, spot};
  const auto image = [](auto texel) {
    auto made = std::make_shared<model::Image>();
    made->width = 64, made->height = 32, made->channels = 4;
    for (int i = 0; i < 64 * 32; ++i) {
      const std::array<std::uint8_t, 4> rgba = texel(i % 64, i / 64);
      made->pixels.insert(made->pixels.end(), rgba.begin(), rgba.end());
    }
    return made;
  };
  using Texel = std::array<std::uint8_t, 4>;
  model::Material tiles = Matt(0.9, 0.8, 0.7), rough = Matt(0.5, 0.6, 0.7),
                  mesh = Matt(0.8, 0.8, 0);
  tiles.base_colour_map = image([](int x, int y) {
    const std::uint8_t shade = (x / 8 + y / 8) % 2 == 0 ? 230 : 90;
    return Texel{shade, static_cast<std::uint8_t>(4 * x), shade, 255};
  });
  rough.normal_map = image([](int x, int y) {
    return Texel{static_cast<std::uint8_t>(128 + 5 * (x % 9)),
                 static_cast<std::uint8_t>(128 - 6 * (y % 7)), 230, 255};
  });
  mesh.base_colour_map = image([](int x, int y) {
    return Texel{200, 180, 60, static_cast<std::uint8_t>((x / 4 + y / 4) % 2 == 0 ? 255 : 0)};
  });
  mesh.alpha_mask = true;
  model::Material metal;
  metal.base_colour = {0.8, 0.6, 0.3, 1};
  metal.metalness = 0.8, metal.roughness = 0.3;
  scene.Add("floor", geometry::Box{{30, 30, 0.1}}, {{0, 0, -0.05}, {}}, tiles, true);
  scene.Add("wall", geometry::Box{{0.1, 4, 2}}, {{6, 0, 1}, {}}, rough, true);
  scene.Add("fence", geometry::Box{{0.1, 2, 1}}, {{4, 1.5, 0.5}, {}}, mesh);
  scene.Add("ball", geometry::Sphere{0.5}, {{3, 0.5, 0.5}, {}}, metal);
  scene.Add("post", geometry::Cylinder{0.2, 1.5}, {{4, -0.8, 0.75}, {}}, Matt(0.7, 0.1, 0.1));
  scene.Add("pane", geometry::Box{{0.02, 1, 1}}, {{2.5, -0.8, 0.5}, {}}, Matt(0.2, 0.4, 0.9, 0.4));
  const auto snapshot = scene.Snapshot();
  raster::RasterBatchRenderer eight(1, raster::MakePixelLoops8);
  raster::RasterBatchRenderer sixteen(1, raster::MakePixelLoops16);
  for (const int width : {320, 200, 203, 41, 17, 16, 9, 1}) {
    std::vector<CameraView> views;
    for (int i = 0; i < 8; ++i) {
      views.push_back(
          {{{-0.2 * i, 0, 0.3 + 0.2 * i}, geometry::FromRollPitchYaw({0.1 * i, 0.05 * i, 0})},
           {width, 90 + width % 2, 1.1, 0.05, 60}});
    }
    const auto expected = eight.Draw(*snapshot, views), drawn = sixteen.Draw(*snapshot, views);
    ASSERT_TRUE(expected && drawn);
    for (std::size_t i = 0; i < views.size(); ++i) {
      EXPECT_EQ(drawn->at(i)->pixels, expected->at(i)->pixels) << width << ", view " << i;
    }
  }
}

// The wall on the left ends in the middle of a vector of pixels. Its normal map and its second side
// must not change the wall on the right.
TEST(RasterBatchRenderer, SurfacesDoNotChangeTheirNeighboursInAVector) {
  model::Light sun;
  sun.direction = geometry::Normalized(geometry::Vector3{0.6, 0.3, -0.7});
  sun.cast_shadows = false;
  auto bumps = std::make_shared<model::Image>();
  bumps->width = bumps->height = 16;
  for (int i = 0; i < 16 * 16; ++i) {
    const auto x = static_cast<std::uint8_t>(128 + 15 * (i % 7)),
               y = static_cast<std::uint8_t>(128 - 15 * (i % 5));
    bumps->pixels.insert(bumps->pixels.end(), {x, y, 200});
  }
  model::Material left = Matt(0.2, 0.6, 0.3);
  left.normal_map = bumps;
  left.double_sided = true;
  const auto drawn = [&](bool with_left) {
    TestScene scene;
    scene.description().lights = {sun};
    if (with_left) scene.Add("left", geometry::Box{{0.1, 2, 2}}, {{3, 1, 0}, {}}, left);
    scene.Add("right", geometry::Box{{0.1, 2, 2}}, {{3, -1, 0}, {}}, Matt(0.9, 0.8, 0.7));
    raster::RasterBatchRenderer renderer(1);
    const auto images = renderer.Draw(*scene.Snapshot(), {{{}, {203, 90, 1.1, 0.05, 60}}});
    EXPECT_TRUE(images);
    return images->at(0)->pixels;
  };
  const auto both = drawn(true), alone = drawn(false);
  EXPECT_NE(both, alone);
  int compared = 0;
  for (std::size_t y = 0; y < 90; ++y) {
    // The walls meet at column 101. Antialiasing changes its neighbours.
    for (std::size_t x = 103; x < 203; ++x) {
      for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t at = 3 * (203 * y + x) + c;
        ASSERT_EQ(both[at], alone[at]) << "column " << x << ", row " << y;
        ++compared;
      }
    }
  }
  EXPECT_EQ(compared, 90 * 100 * 3);
}

// Several threads draw the shadow map in bands of rows. The shadows of posts and balls cross the
// borders between bands.
TEST(RasterBatchRenderer, DrawsEqualShadowsByOneAndBySeveralThreads) {
  TestScene scene;
  model::Light sun;
  sun.direction = geometry::Normalized(geometry::Vector3{0.5, 0.3, -0.6});
  scene.description().lights = {sun};
  scene.Add("floor", geometry::Box{{24, 24, 0.1}}, {{0, 0, -0.05}, {}}, Matt(0.9, 0.8, 0.7), true);
  constexpr int kSide = 5;
  for (int i = 0; i < kSide * kSide; ++i) {
    const geometry::Pose pose{{4.0 * (i % kSide) - 8, 4.0 * (i / kSide) - 8, 0.8}, {}};
    if (i % 2 == 0) {
      scene.Add("ball" + std::to_string(i), geometry::Sphere{0.8}, pose, Matt(0.7, 0.1, 0.1));
    } else {
      scene.Add("post" + std::to_string(i), geometry::Cylinder{0.2, 1.6}, pose, Matt(0, 0, 0.6));
    }
  }
  const auto still = scene.Snapshot();
  const CameraView view{{{0, 0, 30}, geometry::FromRollPitchYaw({0, std::numbers::pi / 2, 0})},
                        {300, 300, 1.0, 0.05, 60}};
  raster::RasterBatchRenderer one(1), three(3), sixteen(16);
  std::vector<std::uint8_t> last;
  for (int i = 0; i < 6; ++i) {
    auto snapshot = std::make_shared<world::Snapshot>(*still);
    for (std::size_t b = 1; b < snapshot->state.bodies.size(); ++b) {
      snapshot->state.bodies[b].world_from_model.position.x +=
          0.13 * i * static_cast<double>(b % 3);
      snapshot->state.bodies[b].world_from_model.position.y += 0.11 * i;
    }
    const auto expected = one.Draw(*snapshot, {view});
    const auto by_three = three.Draw(*snapshot, {view});
    const auto by_sixteen = sixteen.Draw(*snapshot, {view});
    ASSERT_TRUE(expected && by_three && by_sixteen);
    EXPECT_EQ(by_three->at(0)->pixels, expected->at(0)->pixels) << i;
    EXPECT_EQ(by_sixteen->at(0)->pixels, expected->at(0)->pixels) << i;
    EXPECT_NE(expected->at(0)->pixels, last);
    last = expected->at(0)->pixels;
  }
}

}  // namespace
}  // namespace gsv::rendering
