#include "apps/gsv/serving/ros2_spawner.h"

#include <algorithm>
#include <filesystem>
#include <string_view>

#include "apps/gsv/machine/installation.h"
#include "gsv/base/spelling.h"
#include "gsv/model/drive_guess.h"
#include "gsv/ros2/services/results.h"

namespace gsv::app {
namespace {

constexpr std::string_view kModelScheme = "model://";
constexpr std::string_view kFileScheme = "file://";
constexpr std::size_t kMaxUri = 4096;

bool IsFile(const std::string& uri) { return uri.starts_with(kFileScheme) || uri.starts_with('/'); }

base::Status CheckLength(const std::string& uri) {
  if (uri.size() <= kMaxUri) return {};
  return base::Fail(base::ErrorCode::kInvalidArgument, "the URI is longer than 4096 bytes");
}

bool IsForRobots(const model::Model& model) {
  return model.drive || !model.control_systems.empty() ||
         model::GuessDrive(model).kind != model::DriveKind::kNone;
}

}  // namespace

std::vector<ros2::Spawner::World> Ros2Spawner::Worlds() {
  std::vector<World> worlds;
  for (std::string& name : factory_.Worlds()) {
    const auto file = FindWorld(name);
    if (file) worlds.push_back({std::move(name), *file});
  }
  return worlds;
}

std::vector<ros2::Spawner::Spawnable> Ros2Spawner::Spawnables() {
  std::vector<Spawnable> all;
  const auto add = [&](const std::string& name, bool is_robot) {
    all.push_back({std::string(kModelScheme) + name, is_robot});
  };
  for (const auto& model : factory_.Models()) {
    if (!model.is_avatar) add(model.name, true);
  }
  for (const std::string& object : factory_.Objects()) add(object, false);
  return all;
}

base::Result<std::string> Ros2Spawner::FileOf(const std::string& uri) const {
  if (!reads_files_) {
    return base::Fail(
        base::ErrorCode::kInvalidArgument,
        "gsv reads no files that a request names, because other machines can reach it. "
        "Use --model-path and a model's name, or a built-in world",
        uri);
  }
  std::string file = uri.starts_with('/') ? uri : uri.substr(kFileScheme.size());
  std::error_code ignored;
  if (std::filesystem::exists(file, ignored)) return file;
  return base::Fail(base::ErrorCode::kNotFound, "there is no such file", file);
}

base::Result<std::string> Ros2Spawner::WorldOf(const std::string& uri) {
  if (auto ok = CheckLength(uri); !ok) return base::Fail(ok.error());
  std::vector<std::string> names;
  for (World& world : Worlds()) {
    if (uri == world.name || uri == world.uri || uri == std::string(kFileScheme) + world.uri) {
      return std::move(world.name);
    }
    names.push_back(std::move(world.name));
  }
  if (IsFile(uri)) return FileOf(uri);
  return base::Fail(base::ErrorCode::kNotFound,
                    "there is no world of this name; GetAvailableWorlds lists the names" +
                        base::DidYouMean(uri, names),
                    uri);
}

base::Result<std::vector<ros2::Spawner::NamedPose>> Ros2Spawner::NamedPoses(
    const simulation::Simulation& simulation) {
  auto read = library_.ReadNamedPoses(*simulation.specification().world);
  if (!read) return base::Fail(read.error());
  std::vector<NamedPose> poses;
  for (formats::NamedPose& each : *read) {
    poses.push_back({std::move(each.name), each.world_from_pose});
  }
  return poses;
}

base::Status Ros2Spawner::LoadWorld(const std::string& uri, bool is_strict) {
  auto world = WorldOf(uri);
  if (!world) return base::Fail(world.error());
  gateway::SimulationRequest request;
  request.scenario.world = *std::move(world);
  if (is_strict) {
    const auto preview = factory_.Show(request);
    if (!preview) return base::Fail(preview.error().error);
    if (!preview->warnings.empty()) {
      return base::Fail(base::ErrorCode::kCorrupt, preview->warnings.front(), uri);
    }
  }
  const auto created = factory_.Create(request);
  if (!created) return base::Fail(created.error().error);
  return replace_(*created);
}

base::Status Ros2Spawner::UnloadWorld() { return replace_(nullptr); }

base::Result<std::string> Ros2Spawner::ModelOf(const std::string& uri) {
  if (auto ok = CheckLength(uri); !ok) return base::Fail(ok.error());
  if (IsFile(uri)) return FileOf(uri);
  std::string name = uri.starts_with(kModelScheme) ? uri.substr(kModelScheme.size()) : uri;
  std::vector<std::string> known = factory_.Objects();
  for (const auto& model : factory_.Models()) known.push_back(model.name);
  if (std::find(known.begin(), known.end(), name) != known.end()) return name;
  return base::Fail(base::ErrorCode::kNotFound,
                    "there is no model of this name; GetSpawnables lists the names" +
                        base::DidYouMean(name, known),
                    uri);
}

base::Result<std::string> Ros2Spawner::Spawn(simulation::Simulation& simulation,
                                             const ros2::SpawnRequest& request) {
  const auto name = ModelOf(request.uri);
  if (!name) return base::Fail(name.error());
  base::Problems problems;
  const auto model = library_.ReadModel(*name, problems);
  if (!model) {
    base::Error error = model.error();
    error.code = base::ErrorCode::kCorrupt;
    return base::Fail(std::move(error));
  }
  if (IsForRobots(**model)) {
    simulation::RobotSpecification robot;
    robot.name = request.name;
    robot.model = *model;
    robot.world_from_robot = request.world_from_entity;
    robot.on_ground = request.on_ground;
    return simulation.AddRobot(std::move(robot));
  }
  simulation::ObjectSpecification object;
  object.name = request.name;
  object.model = *model;
  object.world_from_object = request.world_from_entity;
  object.on_ground = request.on_ground;
  base::Result<std::string> added;
  const base::Status status = ros2::EditWhilePaused(simulation, [&]() -> base::Status {
    added = simulation.AddObject(std::move(object));
    if (!added) return base::Fail(added.error());
    return {};
  });
  if (!status) return base::Fail(status.error());
  return added;
}

}  // namespace gsv::app
