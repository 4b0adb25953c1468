#include "apps/gsv/running/prepared_files.h"

#include "apps/gsv/machine/installation.h"
#include "apps/gsv/simulations/sensor_types.h"

namespace gsv::app {
namespace {

constexpr std::size_t kMaxWorlds = 16;  // maximum number of worlds that are kept

// Creates a library without a renderer. Checks of sensors need no renderer, and a renderer would
// start a thread.
base::Result<std::shared_ptr<formats::ModelLibrary>> MakeLibrary(const RuntimeOptions& options) {
  auto sensors = MakeSensorTypes(
      options.sensors, base::Fail(base::ErrorCode::kUnavailable, "files are read without cameras"));
  if (!sensors) return base::Fail(sensors.error());
  formats::ReadOptions reading;
  reading.model_path = options.model_path;
  reading.drives = options.drives;
  reading.limits = options.limits;
  reading.check_sensor = CheckBy(*std::move(sensors));
  return std::make_shared<formats::ModelLibrary>(std::move(reading));
}

}  // namespace

std::shared_ptr<const PreparedWorld> PreparedFiles::WorldAt(const std::string& file) {
  if (const auto known = worlds_.find(file); known != worlds_.end()) return known->second;
  auto prepared = std::make_shared<PreparedWorld>();
  auto read = library_->ReadWorld(file, prepared->problems);
  if (!read) return nullptr;
  prepared->description = std::make_shared<const model::WorldDescription>(*std::move(read));
  if (worlds_.size() >= kMaxWorlds) worlds_.clear();
  return worlds_[file] = std::move(prepared);
}

void PreparedFiles::Provide(RunOptions& options) {
  const auto world = FindWorld(options.scenario.world);
  if (!world) return;
  Key key{options.runtime.model_path, options.runtime.drives, options.runtime.sensors.plugins,
          options.runtime.limits};
  if (library_ == nullptr || !(key == key_)) {
    auto library = MakeLibrary(options.runtime);
    if (!library) return;
    worlds_.clear();
    library_ = *std::move(library);
    key_ = std::move(key);
  }
  options.runtime.library = library_;
  options.prepared_world = WorldAt(*world);
  if (options.prepared_world == nullptr) return;
  // Reads the models only to have the library cache them for the run.
  for (const auto* entries : {&options.scenario.robots, &options.scenario.avatars}) {
    for (const scenario::RobotEntry& entry : *entries) {
      base::Problems reported_by_the_run;
      if (entry.model.empty()) continue;
      (void)library_->ReadModel(entry.model, reported_by_the_run,
                                options.prepared_world->description->source);
    }
  }
}

}  // namespace gsv::app
