#include "gsv/gateway/drawing/view_source.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "gsv/gateway/recorded/recorded_view.h"
#include "gsv/sensing/sensor_set.h"
#include "gsv/view/framing.h"

namespace gsv::gateway::drawing {
namespace {

using SnapshotPtr = std::shared_ptr<const world::Snapshot>;

base::Result<view::SensorView> SensorViewOf(const simulation::Simulation& simulation,
                                            const world::Snapshot& snapshot,
                                            const std::string& robot, const std::string& name) {
  const int body = snapshot.layout->Find(robot);
  const auto sensors =
      body < 0 ? std::vector<model::SensorDescription>() : simulation.sensors(robot);
  const auto found = std::find_if(sensors.begin(), sensors.end(),
                                  [&](const auto& sensor) { return sensor.name == name; });
  if (found == sensors.end()) {
    return base::Fail(base::ErrorCode::kNotFound,
                      "there is no camera '" + robot + "/" + name + "'");
  }
  const auto made = sensing::SensorSet(simulation.sensor_types()).Of(*found);
  const auto frustum = made ? (*made)->frustum() : std::nullopt;
  if (!frustum) {
    return base::Fail(base::ErrorCode::kNotFound, "'" + robot + "/" + name + "' is not a camera");
  }
  return view::SensorView{world::LinkPose(snapshot, body, found->link) * found->link_from_sensor,
                          frustum->horizontal_fov};
}

class LiveSource final : public ViewSource {
 public:
  explicit LiveSource(const std::shared_ptr<simulation::Simulation>& simulation)
      : simulation_(simulation) {}

  base::Result<ViewInstant> Now() override {
    const auto simulation = simulation_.lock();
    if (!simulation) return base::Fail(base::ErrorCode::kEnded, "the simulation has been removed");
    const SnapshotPtr snapshot = simulation->snapshot();
    const auto pose = [snapshot](const std::string& body) -> std::optional<geometry::Pose> {
      const int index = snapshot->layout->Find(body);
      if (index < 0) return std::nullopt;
      return snapshot->state.bodies[static_cast<std::size_t>(index)].world_from_model;
    };
    const auto sensor = [simulation, snapshot](const std::string& robot, const std::string& name) {
      return SensorViewOf(*simulation, *snapshot, robot, name);
    };
    return ViewInstant{snapshot,
                       {pose, sensor, [this, snapshot] { return Corners(*snapshot); }},
                       snapshot->state.time};
  }

 private:
  // Returns the corners that the default view shows. The first snapshot of a layout determines the
  // corners, so that the view does not move with the bodies.
  std::vector<geometry::Vector3> Corners(const world::Snapshot& snapshot) {
    if (layout_ != snapshot.layout) {
      corners_ = view::CornersToShow(snapshot);
      layout_ = snapshot.layout;
    }
    return corners_;
  }

  const std::weak_ptr<simulation::Simulation> simulation_;
  std::shared_ptr<const world::Layout> layout_;
  std::vector<geometry::Vector3> corners_;
};

class ReplaySource final : public ViewSource {
 public:
  explicit ReplaySource(std::shared_ptr<ReplayPlayer> player)
      : player_(std::move(player)), view_(player_->reader(), player_->scene()) {}

  base::Result<ViewInstant> Now() override {
    messages::gsv_msgs::Poses poses = player_->poses();
    const bool is_known = instant_.snapshot != nullptr && poses.step == shown_.step &&
                          poses.layout_version == shown_.layout_version &&
                          poses.poses == shown_.poses;
    if (!is_known) {
      auto instant = view_.At(poses);
      if (!instant) return base::Fail(instant.error());
      instant_ = *std::move(instant);
      shown_ = std::move(poses);
    }
    return ViewInstant{instant_.snapshot, instant_.scene->LookupAt(*instant_.snapshot),
                       player_->clock().position()};
  }

 private:
  const std::shared_ptr<ReplayPlayer> player_;
  RecordedView view_;
  messages::gsv_msgs::Poses shown_;
  RecordedView::Instant instant_;
};

}  // namespace

std::unique_ptr<ViewSource> MakeLiveSource(
    const std::shared_ptr<simulation::Simulation>& simulation) {
  return std::make_unique<LiveSource>(simulation);
}

std::unique_ptr<ViewSource> MakeReplaySource(std::shared_ptr<ReplayPlayer> player) {
  return std::make_unique<ReplaySource>(std::move(player));
}

}  // namespace gsv::gateway::drawing
