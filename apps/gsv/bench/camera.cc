#include <algorithm>
#include <bitset>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <string>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/gsv/bench/bench.h"
#include "apps/gsv/process/exit_code.h"
#include "apps/gsv/process/option_values.h"
#include "apps/gsv/scenes/moving_scene.h"
#include "gsv/base/mutex.h"
#include "gsv/rendering/images/jpeg.h"
#include "gsv/rendering/renderer.h"

namespace gsv::app {
namespace {

using Clock = std::chrono::steady_clock;
using Images = std::vector<std::shared_ptr<const model::Image>>;

struct CameraArguments {
  int cameras = 64;
  std::string size = "320x240";
  int robots = 50;
  std::string world = "office", model = "b21r";
  bool overview = false;
  double duration = 10;  // wall-clock time, s
  std::string save;
  bool opengl = false, json = false;
};

// Provides snapshots and measures the intervals between them.
class SnapshotWatch final : public simulation::Observer {
 public:
  void OnSnapshot(const std::shared_ptr<const world::Snapshot>& snapshot) override {
    const auto now = Clock::now();
    const base::MutexLock lock(mutex_);
    if (snapshot_ != nullptr) intervals_.push_back(Milliseconds(now - last_));
    last_ = now;
    snapshot_ = snapshot;
    is_new_.notify_all();
  }
  void OnEvent(const simulation::Event&) override {}

  // Waits for a new snapshot and returns the latest one. Returns null if none comes within 10 s.
  std::shared_ptr<const world::Snapshot> Next() {
    base::MutexLock lock(mutex_);
    const bool came = is_new_.wait_for(lock, std::chrono::seconds(10), [&]() GSV_REQUIRES(mutex_) {
      return snapshot_ != handed_over_;
    });
    return came ? handed_over_ = snapshot_ : nullptr;
  }
  std::vector<double> intervals() {  // Returns the intervals in ms.
    const base::MutexLock lock(mutex_);
    return intervals_;
  }
  void Forget() {
    const base::MutexLock lock(mutex_);
    intervals_.clear();
  }

 private:
  base::Mutex mutex_;
  base::ConditionVariable is_new_;
  std::shared_ptr<const world::Snapshot> snapshot_ GSV_GUARDED_BY(mutex_);
  std::shared_ptr<const world::Snapshot> handed_over_ GSV_GUARDED_BY(mutex_);
  Clock::time_point last_ GSV_GUARDED_BY(mutex_);
  std::vector<double> intervals_ GSV_GUARDED_BY(mutex_);
};

// Checks the images of all cameras at one snapshot. Fails if all images are blank, if an image
// equals the previous image of its camera, or if two neighbouring cameras have equal images.
class ImageCheck {
 public:
  base::Status Check(const Images& images) {
    if (std::all_of(images.begin(), images.end(), IsBlank)) return Fail("images are blank");
    for (std::size_t i = 0; i < images.size(); ++i) {
      if (IsBlank(images[i])) continue;  // a robot that is close to a wall has a blank image
      if (i < last_.size() && last_[i]->pixels == images[i]->pixels)
        return Fail("a moving camera's image equals the previous one");
      if (i > 0 && images[i]->pixels == images[i - 1]->pixels)
        return Fail("two cameras have equal images");
    }
    last_ = images;
    return {};
  }

 private:
  // Returns whether the image has fewer than eight different pixel values. The search stops at the
  // eighth value, because the measured time of a batch of images includes this check.
  static bool IsBlank(const std::shared_ptr<const model::Image>& image) {
    constexpr int kMinImages = 8;
    std::bitset<256> seen;
    int shades = 0;
    for (const std::uint8_t shade : image->pixels) {
      if (seen[shade]) continue;
      seen.set(shade);
      if (++shades == kMinImages) return false;
    }
    return true;
  }
  static base::Status Fail(const std::string& what) {
    return base::Fail(base::ErrorCode::kUnavailable, what, "bench camera");
  }
  Images last_;
};

struct Figures {
  std::string renderer;
  std::uint64_t triangles = 0;
  int images = 0;
  double wall = 0, processor = 0;  // in s
  double least_processor = 1e9;    // smallest processor time of a batch, s
  std::vector<double> latencies;   // times from the request to the images, ms
  std::vector<double> intervals;   // times from one step to the next step, ms
};

base::Status Save(const std::string& folder, const Images& images) {
  for (std::size_t i = 0; i < images.size(); ++i) {
    const auto jpeg = rendering::EncodeJpeg(*images[i], 95);
    if (!jpeg) return base::Fail(jpeg.error());
    const std::string path = folder + "/camera_" + std::to_string(i) + ".jpg";
    std::ofstream file(path, std::ios::binary);
    file.write(reinterpret_cast<const char*>(jpeg->data()),
               static_cast<std::streamsize>(jpeg->size()));
    if (!file.flush()) {
      return base::Fail(base::ErrorCode::kUnavailable,
                        "the image cannot be written; check that the folder exists and that its "
                        "disk has free space",
                        path);
    }
  }
  return {};
}

base::Result<Figures> Measure(const CameraArguments& arguments,
                              const rendering::CameraParameters& camera) {
  MovingSceneOptions scene_options;
  scene_options.world = arguments.world;
  scene_options.model = arguments.model;
  scene_options.robots = arguments.robots;
  auto scene = MovingScene::Create(scene_options);
  if (!scene) return base::Fail(scene.error());
  simulation::Simulation& simulation = *scene->simulation;
  rendering::RendererOptions options;
  if (arguments.opengl) options.back_end = rendering::BackEnd::kOpenGl;
  auto renderer = rendering::Renderer::Start(options);
  if (!renderer) return base::Fail(renderer.error());
  Figures figures;
  figures.renderer = (*renderer)->renderer_name();
  figures.triangles = TrianglesIn(*simulation.snapshot()->layout);

  const auto draw = [&](const std::shared_ptr<const world::Snapshot>& snapshot) {
    const auto views = arguments.overview ? scene->Overviews(*snapshot, arguments.cameras, camera)
                                          : scene->RobotViews(*snapshot, arguments.cameras, camera);
    return (*renderer)->Draw(snapshot, views, std::chrono::minutes(5));
  };
  // The first image includes work that is done once for a world, so it is not measured.
  const auto first = draw(simulation.snapshot());
  if (!first) return base::Fail(first.error());
  if (!arguments.save.empty()) {
    if (auto ok = Save(arguments.save, *first); !ok) return base::Fail(ok.error());
  }
  auto watch = std::make_shared<SnapshotWatch>();
  simulation.AddObserver(watch);
  if (auto ok = simulation.Start(); !ok) return base::Fail(ok.error());
  ImageCheck check;
  Clock::time_point start;
  double processor_start = 0;
  // The first two batches are not measured, because during these the renderer detects which objects
  // move.
  for (int round = -2;
       round <= 0 || Clock::now() - start < std::chrono::duration<double>(arguments.duration);
       ++round) {
    if (round <= 0) start = Clock::now(), processor_start = ProcessorTime();
    if (round == 0) watch->Forget();
    const auto snapshot = watch->Next();
    if (snapshot == nullptr)
      return base::Fail(base::ErrorCode::kTimeout, "the simulation does not advance",
                        "bench camera");
    const auto asked = Clock::now();
    const double processor_asked = ProcessorTime();
    const auto images = draw(snapshot);
    if (!images) return base::Fail(images.error());
    if (round < 0) continue;
    figures.latencies.push_back(Milliseconds(Clock::now() - asked));
    figures.least_processor = std::min(figures.least_processor, ProcessorTime() - processor_asked);
    figures.images += arguments.cameras;
    if (auto ok = check.Check(*images); !ok) return base::Fail(ok.error());
  }
  figures.wall = std::chrono::duration<double>(Clock::now() - start).count();
  figures.processor = ProcessorTime() - processor_start;
  figures.intervals = watch->intervals();
  return figures;
}

std::optional<rendering::CameraParameters> ParseSize(const std::string& size) {
  rendering::CameraParameters camera;
  camera.near = 0.05, camera.far = 200;
  char beyond = 0;
  if (std::sscanf(size.c_str(), "%dx%d%c", &camera.width, &camera.height, &beyond) != 2) return {};
  if (!rendering::Check(camera)) return {};
  return camera;
}

int Run(const CameraArguments& arguments) {
  const auto camera = ParseSize(arguments.size);
  if (!camera) {
    return PrintError({base::ErrorCode::kInvalidArgument,
                       "give width and height in pixels, up to 4096 each, such as 320x240",
                       "--size " + arguments.size});
  }
  const auto figures = Measure(arguments, *camera);
  if (!figures) return PrintError(figures.error());
  const nlohmann::ordered_json json{
      {"cameras", arguments.cameras},
      {"size", arguments.size},
      {"robots", arguments.robots},
      {"triangles", figures->triangles},
      {"pictures", figures->images},
      {"pictures_per_s", figures->images / figures->wall},
      {"p50_ms", QuantileOf(figures->latencies, 0.5)},
      {"p99_ms", QuantileOf(figures->latencies, 0.99)},
      {"step_p50_ms", QuantileOf(figures->intervals, 0.5)},
      {"step_p99_ms", QuantileOf(figures->intervals, 0.99)},
      {"cpu_ms_a_picture", 1e3 * figures->processor / figures->images},
      {"least_cpu_ms_a_picture", 1e3 * figures->least_processor / arguments.cameras},
      {"renderer", figures->renderer}};
  PrintFigures(json, arguments.json);
  return kOk;
}

}  // namespace

void AddCameraBench(const CommandLine& bench) {
  CLI::App* command = bench.app.add_subcommand(
      "camera", "Measure throughput and latency of camera images of driving robots, in real time");
  auto arguments = std::make_shared<CameraArguments>();
  command->add_option("--cameras", arguments->cameras, "images per batch")
      ->type_name("N")
      ->capture_default_str()
      ->check(Between(1, 1024));
  command->add_option("--size", arguments->size, "width and height of an image in pixels")
      ->capture_default_str();
  command->add_option("--robots", arguments->robots, "number of robots")
      ->type_name("N")
      ->capture_default_str()
      ->check(Between(1, 10'000));
  command
      ->add_option("--world", arguments->world,
                   "world, or \"square\" for the world of `gsv bench crowd`")
      ->type_name("WORLD")
      ->capture_default_str();
  command->add_option("--model", arguments->model, "model of the robots")
      ->type_name("MODEL")
      ->capture_default_str();
  command->add_flag("--overview", arguments->overview,
                    "use cameras that circle above the world, instead of the robots' cameras");
  command->add_option("--duration", arguments->duration, "wall-clock time of the measurement")
      ->type_name("SECONDS")
      ->capture_default_str()
      ->check(Between(0.1, 3600.0));
  command->add_option("--save", arguments->save, "save the first batch as JPEG")
      ->type_name("FOLDER");
  command->add_flag("--opengl", arguments->opengl,
                    "render with OpenGL, in software if there is no graphics card");
  command->add_flag("--json", arguments->json, "print one JSON object");
  command->callback([arguments, bench] { bench.exit_code = Run(*arguments); });
}

}  // namespace gsv::app
