#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <limits>
#include <numbers>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/gsv/commands/commands.h"
#include "apps/gsv/machine/installation.h"
#include "apps/gsv/process/exit_code.h"
#include "apps/gsv/process/option_values.h"
#include "apps/gsv/running/image_file.h"
#include "apps/gsv/scenes/model_alone.h"
#include "apps/gsv/scenes/moving_scene.h"
#include "apps/gsv/serving/limit_option.h"
#include "gsv/base/counted.h"
#include "gsv/formats/sdf_reader.h"
#include "gsv/geometry/box_corners.h"
#include "gsv/rendering/renderer.h"
#include "gsv/simulation/simulation.h"
#include "gsv/view/framing.h"

namespace gsv::app {
namespace {

using geometry::Pose;
using geometry::Vector3;

struct DrawArguments {
  std::string file, image;
  std::vector<std::string> model_path;
  formats::ReadLimits limits;
  int width = 640, height = 480;
  bool json = false;
};

// Returns the world at the start of a simulation, with pedestrians at their starts. A world that
// cannot be simulated is accepted if it has no pedestrians.
base::Result<std::shared_ptr<const world::Snapshot>> FirstInstant(
    model::WorldDescription description) {
  auto world = std::make_shared<const model::WorldDescription>(std::move(description));
  if (!world->pedestrians.empty()) {
    simulation::Specification specification;
    specification.world = world;
    specification.mode = simulation::Mode::kLockstep;
    const auto created = simulation::Simulation::Create(
        std::move(specification), std::make_shared<const sensing::SensorRegistry>());
    if (!created) return base::Fail(created.error());
    return (*created)->snapshot();
  }
  std::vector<world::Body> bodies;
  for (const model::PlacedModel& placed : world->models) {
    world::Body body;
    body.name = placed.name;
    body.model = placed.model;
    body.initial_pose = placed.world_from_model;
    bodies.push_back(std::move(body));
  }
  auto snapshot = std::make_shared<world::Snapshot>();
  snapshot->layout = world::MakeLayout(1, std::move(bodies), std::move(world));
  snapshot->state = world::InitialState(*snapshot->layout);
  return snapshot;
}

int Run(const DrawArguments& arguments) {
  const auto file = FindWorld(arguments.file);
  if (!file) return PrintError(file.error());
  formats::ReadOptions options;
  options.limits = arguments.limits;
  options.model_path.assign(arguments.model_path.begin(), arguments.model_path.end());
  formats::ModelLibrary library(std::move(options));
  base::Problems problems = CheckModelPath(arguments.model_path);
  for (const base::Problem& problem : problems) {
    std::fprintf(stderr, "gsv: warning: %s\n", problem.Sentence().c_str());
  }
  const auto start = std::chrono::steady_clock::now();
  const std::clock_t processor_start = std::clock();
  auto world = library.ReadWorld(*file, problems);
  const std::chrono::duration<double> reading = std::chrono::steady_clock::now() - start;
  const double processor = static_cast<double>(std::clock() - processor_start) / CLOCKS_PER_SEC;
  if (!world) return PrintError(world.error());
  if (IsModelAlone(*world)) StandModelOnGround(*world);
  const auto first = FirstInstant(*std::move(world));
  if (!first) return PrintError(first.error());
  const auto& snapshot = *first;
  auto renderer = rendering::Renderer::Start();
  if (!renderer) return PrintError(renderer.error());
  const rendering::CameraView overview =
      view::Overview(view::CornersToShow(*snapshot), arguments.width, arguments.height);
  const auto image = (*renderer)->Draw(snapshot, overview, std::chrono::minutes(1));
  if (!image) return PrintError(image.error());
  if (auto written = WriteImage(**image, arguments.image); !written) {
    return PrintError(written.error());
  }
  const nlohmann::ordered_json json{{"models", snapshot->layout->bodies.size()},
                                    {"lights", snapshot->layout->description->lights.size()},
                                    {"triangles", TrianglesIn(*snapshot->layout)},
                                    {"reading_s", reading.count()},
                                    {"processor_s", processor},
                                    {"problems", problems.size()},
                                    {"renderer", (*renderer)->renderer_name()}};
  if (arguments.json) {
    std::printf("%s\n", json.dump().c_str());
  } else {
    std::printf("%s: %s, %s, read in %.2f s\n", arguments.image.c_str(),
                base::Counted(snapshot->layout->bodies.size(), "model").c_str(),
                base::Counted(TrianglesIn(*snapshot->layout), "triangle").c_str(), reading.count());
  }
  return kOk;
}

}  // namespace

void AddDrawCommand(const CommandLine& line) {
  CLI::App* command = line.app.get_subcommand("world")->add_subcommand(
      "draw", "Draw an image of a world or a model");
  auto arguments = std::make_shared<DrawArguments>();
  command->add_option("file", arguments->file, "file, folder or name of the world or model")
      ->required();
  auto* output =
      command
          ->add_option("-o,--output", arguments->image, "image to write, .jpg or .png (required)")
          ->type_name("FILE")
          ->check(CheckImageName);
  command->add_option("image", arguments->image, "image to write, instead of --output")
      ->check(CheckImageName)
      ->excludes(output);
  command->add_option("--model-path", arguments->model_path, "folder to search for models")
      ->type_name("FOLDER");
  AddLimitOption(*command, arguments->limits);
  command->add_option("--width", arguments->width, "width of the image")
      ->type_name("PIXELS")
      ->capture_default_str()
      ->check(Between(16, rendering::kMaxImageSide));
  command->add_option("--height", arguments->height, "height of the image")
      ->type_name("PIXELS")
      ->capture_default_str()
      ->check(Between(16, rendering::kMaxImageSide));
  command->add_flag("--json", arguments->json, "print a summary of the file as one JSON object");
  command->callback([arguments, line] {
    if (arguments->image.empty()) throw CLI::RequiredError("--output");
    line.exit_code = Run(*arguments);
  });
}

}  // namespace gsv::app
