#include "gsv/rendering/renderer.h"

#include <future>

#include <gtest/gtest.h>

#include "gsv/rendering/testing/test_scene.h"

namespace gsv::rendering {
namespace {

constexpr std::chrono::seconds kLong{30};

std::shared_ptr<Renderer> StartRenderer(RendererOptions options = {}) {
  auto started = Renderer::Start(options);
  EXPECT_TRUE(started) << started.error().Sentence();
  return started ? *started : nullptr;
}

std::shared_ptr<const model::Image> Grey() {
  auto image = std::make_shared<model::Image>();
  image->width = image->height = 2;
  image->pixels.assign(12, 128);
  return image;
}

TEST(Renderer, ReportsTheNameOfItsBackEnd) {
  RendererOptions options;
  options.back_end = BackEnd::kOpenGl;
  EXPECT_NE(StartRenderer(options)->renderer_name().find("OpenGL"), std::string::npos);
  options.back_end = BackEnd::kRasteriser;
  EXPECT_NE(StartRenderer(options)->renderer_name().find("rasteriser"), std::string::npos);
}

TEST(Renderer, RejectsAnInvalidCamera) {
  const auto renderer = StartRenderer();
  const auto image = renderer->Draw(TestScene().Snapshot(), CameraView{{}, {0, 240, 1, 0.1, 100}});
  ASSERT_FALSE(image);
  EXPECT_EQ(image.error().code, base::ErrorCode::kInvalidArgument);
}

TEST(Renderer, FreesTheDataOfARemovedBody) {
  const auto renderer = StartRenderer();
  TestScene scene;
  const CameraView view{{}, {32, 24, 1, 0.1, 100}};
  const auto draw = [&] { ASSERT_TRUE(renderer->Draw(scene.Snapshot(), view, kLong)); };
  draw();
  EXPECT_EQ(renderer->CountCopies().meshes, 0u);

  model::Material material;
  material.base_colour_map = Grey();
  auto mesh =
      std::make_shared<const geometry::TriangleMesh>(geometry::Tessellate(geometry::Cone{}));
  scene.Add("cone", geometry::Mesh{std::move(mesh)}, {{2, 0, 0}, {}}, std::move(material));
  scene.Add("ball", geometry::Sphere{}, {{2, 0, 0}, {}}, {});
  {
    const auto snapshot = scene.Snapshot();
    ASSERT_TRUE(renderer->Draw(snapshot, view, kLong));
    const DrawCopies held = renderer->CountCopies();
    EXPECT_EQ(held.meshes, 2u);
    EXPECT_EQ(held.textures, 1u);
    EXPECT_EQ(held.layouts, 1u);
  }
  scene.Remove("cone");
  scene.Remove("ball");
  const DrawCopies left = renderer->CountCopies();
  EXPECT_EQ(left.meshes, 0u);
  EXPECT_EQ(left.textures, 0u);
  EXPECT_EQ(left.layouts, 0u);
}

TEST(Renderer, SharesOneCopyBetweenBodiesAndLayouts) {
  const auto renderer = StartRenderer();
  TestScene scene;
  for (int i = 0; i < 20; ++i) {
    scene.Add("box" + std::to_string(i), geometry::Box{{0.1 * i + 0.1, 1, 1}}, {}, Matt(1, 0, 0));
  }
  const CameraView view{{}, {32, 24, 1, 0.1, 100}};
  const auto first = scene.Snapshot(), second = scene.Snapshot();
  ASSERT_TRUE(renderer->Draw(first, view, kLong) && renderer->Draw(second, view, kLong));
  const DrawCopies held = renderer->CountCopies();
  EXPECT_EQ(held.meshes, 1u);
  EXPECT_EQ(held.layouts, 2u);
}

TEST(Renderer, ServesManyThreadsAtOnce) {
  const auto renderer = StartRenderer();
  TestScene scene;
  scene.Add("left", geometry::Box{{0.5, 0.5, 0.5}}, {{3, 0.8, 0}, {}}, Glowing(1, 0, 0));
  scene.Add("right", geometry::Box{{0.5, 0.5, 0.5}}, {{3, -0.8, 0}, {}}, Glowing(0, 1, 0));
  const auto snapshots = {scene.Snapshot(), scene.Snapshot()};
  constexpr int kThreads = 8;
  std::vector<std::future<bool>> asked;
  asked.reserve(kThreads);
  for (int thread = 0; thread < kThreads; ++thread) {
    asked.push_back(std::async(std::launch::async, [&, thread] {
      bool good = true;
      for (int i = 0; i < 4; ++i) {
        // The camera is rotated slightly to the left or right, so that only one of the boxes is
        // visible.
        const bool left = (thread + i) % 2 == 0;
        const CameraView view{geometry::PlanarPose(0, 0, 0, left ? 0.6 : -0.6),
                              {40 + thread % 2, 30, 0.9, 0.1, 10}};
        const auto image = renderer->Draw(*(snapshots.begin() + i % 2), view, kLong);
        good = good && image && FindBlob(**image, left ? 0 : 1).pixels > 10 &&
               FindBlob(**image, left ? 1 : 0).pixels == 0;
      }
      return good;
    }));
  }
  for (auto& good : asked) EXPECT_TRUE(good.get());
}

TEST(Renderer, DrawsAThousandObjectsInOneWorld) {
  const auto renderer = StartRenderer();
  TestScene scene;
  for (int i = 0; i < 1000; ++i) {
    const int column = i % 40, row = i / 40;
    scene.Add("box" + std::to_string(i), geometry::Box{{0.05, 0.02, 0.02}},
              {{2.0, 0.05 * (column - 20), 0.05 * (row - 12)}, {}}, Glowing(0, 1, 0));
  }
  const auto image =
      renderer->Draw(scene.Snapshot(), CameraView{{}, {320, 240, 1.2, 0.1, 100}}, kLong);
  ASSERT_TRUE(image);
  // A face of 0.02 m at 1.975 m covers (0.02 f / 1.975)² pixels. The box's sides add some.
  const double front = std::pow(0.02 * 160 / std::tan(0.6) / 1.975, 2);
  EXPECT_GT(FindBlob(**image, 1, 1).pixels, 1000 * front * 0.9);
}

TEST(Renderer, ReportsATimeout) {
  const auto renderer = StartRenderer();
  const auto image =
      renderer->Draw(TestScene().Snapshot(), CameraView{{}, {4096, 4096, 1, 0.1, 100}},
                     std::chrono::milliseconds(0));
  ASSERT_FALSE(image);
  EXPECT_EQ(image.error().code, base::ErrorCode::kTimeout);
}

TEST(Renderer, RefusesRequestsWhenItsQueueIsFull) {
  RendererOptions options;
  options.queue_capacity = 0;
  const auto renderer = StartRenderer(options);
  const auto image = renderer->Draw(TestScene().Snapshot(), CameraView{});
  ASSERT_FALSE(image);
  EXPECT_EQ(image.error().code, base::ErrorCode::kUnavailable);
  EXPECT_NE(image.error().message.find("already waiting"), std::string::npos);
}

TEST(Renderer, NamesTheMissingLibraryAndThePackageToInstall) {
  RendererOptions options;
  options.back_end = BackEnd::kOpenGl;
  options.egl.egl_library = "libEGL_that_is_not_there.so.1";
  const auto started = Renderer::Start(options);
  ASSERT_FALSE(started);
  EXPECT_EQ(started.error().code, base::ErrorCode::kUnavailable);
  EXPECT_NE(started.error().message.find("libEGL_that_is_not_there.so.1 cannot be opened"),
            std::string::npos);
  EXPECT_NE(started.error().message.find("install libegl1"), std::string::npos);
}

}  // namespace
}  // namespace gsv::rendering
