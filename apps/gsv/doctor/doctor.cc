#include "apps/gsv/doctor/doctor.h"

#include <chrono>
#include <cstdio>

#include "apps/gsv/doctor/machine_checks.h"
#include "apps/gsv/machine/installation.h"
#include "apps/gsv/process/exit_code.h"
#include "apps/gsv/scenes/moving_scene.h"
#include "gsv/rendering/renderer.h"

namespace gsv::app {
namespace {

constexpr int kRobots = 4;
constexpr int kCameras = 16;
constexpr double kMeasured = 1.5;  // duration of the measurement, s

// Returns the number of images of 320x240 per second, for robots that drive in the office.
base::Result<double> ImageRate(rendering::Renderer& renderer) {
  MovingSceneOptions options;
  options.robots = kRobots;
  const auto scene = MovingScene::Create(options);
  if (!scene) return base::Fail(scene.error());
  const auto draw = [&]() -> base::Status {
    const auto snapshot = scene->simulation->snapshot();
    const auto images = renderer.Draw(
        snapshot, scene->RobotViews(*snapshot, kCameras, {320, 240, 1.047, 0.05, 100}),
        std::chrono::minutes(1));
    return images ? base::Status() : base::Fail(images.error());
  };
  if (auto ok = scene->simulation->Start(); !ok) return base::Fail(ok.error());
  // the first image includes work that is done once for a world
  if (auto ok = draw(); !ok) return base::Fail(ok.error());
  const auto start = std::chrono::steady_clock::now();
  double seconds = 0;
  int drawn = 0;
  while (seconds < kMeasured) {
    if (auto ok = draw(); !ok) return base::Fail(ok.error());
    drawn += kCameras;
    seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  return drawn / seconds;
}

// Returns true if images can be rendered.
bool CheckCameras(bool has_worlds) {
  const auto renderer = rendering::Renderer::Start();
  if (!renderer) {
    std::printf("cameras: none: %s\n", renderer.error().Sentence().c_str());
    return false;
  }
  const std::string name = (*renderer)->renderer_name();
  std::printf("cameras: ok, rendered with %s\n", name.c_str());
  rendering::RendererOptions options;
  options.back_end = rendering::BackEnd::kOpenGl;
  const auto opengl = rendering::Renderer::Start(options);
  if (!opengl) {
    std::printf("graphics driver: none: %s\n", opengl.error().Sentence().c_str());
  } else {
    const std::string driver = (*opengl)->renderer_name();
    std::printf("graphics driver: %s%s\n", driver.c_str(),
                driver == name ? "" : " (not used: no graphics card)");
  }
  if (!has_worlds) return true;
  const auto rate = ImageRate(**renderer);
  if (!rate) {
    std::printf("images: failed: %s\n", rate.error().Sentence().c_str());
    return false;
  }
  std::printf("images: %.0f per second (320x240 pixels, world office, %d cameras)\n", *rate,
              kCameras);
  return true;
}

}  // namespace

int Doctor(const std::string& broker) {
  std::error_code ignored;
  const bool viewer = std::filesystem::exists(ShareFolder() / "web" / "index.html", ignored);
  const bool worlds = FindWorld("office").has_value();
  const bool cameras = CheckCameras(worlds);
  std::printf("viewer: %s %s\n", viewer ? "ok," : "missing:", (ShareFolder() / "web").c_str());
  std::printf("worlds: %s %s\n", worlds ? "ok," : "missing:", (ShareFolder() / "worlds").c_str());
  const bool machine = CheckMachine();
  const bool reached = CheckBroker(broker);
  return cameras && viewer && worlds && machine && reached ? kOk : kInfrastructure;
}

}  // namespace gsv::app
