#include "gsv/reality/maps/map_world.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include <fmt/format.h>

#include "gsv/geometry/constants.h"
#include "gsv/geometry/shape.h"
#include "gsv/sensing/rays/ray_scene.h"
#include "gsv/world/snapshot.h"

namespace gsv::reality {
namespace {

constexpr std::size_t kMaxBoxes = 200'000;
constexpr double kMaxCells = 64e6;
constexpr double kPastASurface = 1e-6;
constexpr int kMaxCrossings = 10'000;
constexpr double kMaxHeight = 1e4;  // m

std::string XmlName(const std::string& name) {
  std::string clean;
  for (const char c : name) {
    const bool is_plain = std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-';
    clean += is_plain ? c : '_';
  }
  return clean.empty() ? "map" : clean;
}

world::Snapshot WithoutRobots(const model::WorldDescription& description) {
  std::vector<world::Body> bodies;
  for (const model::PlacedModel& placed : description.models) {
    world::Body body;
    body.name = placed.name;
    body.model = placed.model;
    body.initial_pose = placed.world_from_model;
    body.kind = world::KindOf(placed);
    if (!body.is_robot()) bodies.push_back(std::move(body));
  }
  world::Snapshot snapshot;
  snapshot.layout = world::MakeLayout(1, std::move(bodies),
                                      std::make_shared<const model::WorldDescription>(description));
  snapshot.state = world::InitialState(*snapshot.layout);
  return snapshot;
}

// Returns the bounds of all bodies with collisions, except planes.
geometry::Bounds Extent(const std::shared_ptr<const world::Snapshot>& snapshot) {
  using geometry::kInfinity;
  geometry::Bounds all{{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
  for (int body = 0; body < static_cast<int>(snapshot->layout->bodies.size()); ++body) {
    const model::Model& model = *snapshot->layout->bodies[body].model;
    for (int link = 0; link < static_cast<int>(model.links.size()); ++link) {
      const geometry::Pose world_from_link = world::LinkPose(*snapshot, body, link);
      for (const model::Collision& collision : model.links[link].collisions) {
        if (std::holds_alternative<geometry::Plane>(collision.shape)) continue;
        const geometry::Bounds box = geometry::BoundsOf(collision.shape);
        for (int corner = 0; corner < 8; ++corner) {
          const geometry::Vector3 p = world_from_link * collision.link_from_collision *
                                      geometry::Vector3{corner & 1 ? box.max.x : box.min.x,
                                                        corner & 2 ? box.max.y : box.min.y,
                                                        corner & 4 ? box.max.z : box.min.z};
          all.min = {std::min(all.min.x, p.x), std::min(all.min.y, p.y), std::min(all.min.z, p.z)};
          all.max = {std::max(all.max.x, p.x), std::max(all.max.y, p.y), std::max(all.max.z, p.z)};
        }
      }
    }
  }
  return all;
}

class Slicer {
 public:
  Slicer(const sensing::RayScene& rays, OccupancyMap& map, double height)
      : rays_(rays), map_(map), height_(height) {}

  // Casts rays along both axes of the grid, so that they also hit thin walls.
  void Run() {
    for (int y = 0; y < map_.height; ++y) Follow(Centre(0, y), {1, 0, 0}, map_.width);
    for (int x = 0; x < map_.width; ++x) Follow(Centre(x, 0), {0, 1, 0}, map_.height);
  }

 private:
  geometry::Vector3 Centre(int x, int y) const {
    return {map_.origin_x + (x + 0.5) * map_.resolution,
            map_.origin_y + (y + 0.5) * map_.resolution, height_};
  }

  void Mark(const geometry::Vector3& place) {
    const auto cell = [&](double along, double origin, int count) {
      const double index = std::floor((along - origin) / map_.resolution);
      return static_cast<std::size_t>(std::clamp(index, 0.0, count - 1.0));
    };
    map_.cells[cell(place.y, map_.origin_y, map_.height) * static_cast<std::size_t>(map_.width) +
               cell(place.x, map_.origin_x, map_.width)] = Cell::kOccupied;
  }

  // Whether the middle of a cell is inside a solid. A vertical ray upwards from there hits the
  // surface of the solid from inside.
  bool IsSolid(const geometry::Vector3& place) const {
    const auto middle = [&](double along, double origin) {
      return origin + (std::floor((along - origin) / map_.resolution) + 0.5) * map_.resolution;
    };
    geometry::Vector3 from{middle(place.x, map_.origin_x), middle(place.y, map_.origin_y), height_};
    int crossings = 0;
    while (crossings < kMaxCrossings) {
      const auto hit = rays_.Cast({from, {0, 0, 1}, kMaxHeight}, -1);
      if (!hit) break;
      from.z += hit->distance + kPastASurface;
      ++crossings;
    }
    return crossings % 2 == 1;
  }

  // Marks the cells of all surfaces along a ray. A surface on the border of two cells belongs to
  // the cell that is inside the solid.
  void Follow(geometry::Vector3 place, const geometry::Vector3& direction, int cells) {
    double left = cells * map_.resolution;
    const geometry::Vector3 nudge = 1e-3 * map_.resolution * direction;
    for (int i = 0; i < kMaxCrossings && left > 0; ++i) {
      const auto hit = rays_.Cast({place, direction, left}, -1);
      if (!hit) break;
      const geometry::Vector3 there = place + hit->distance * direction;
      Mark(IsSolid(there - nudge) && !IsSolid(there + nudge) ? there - nudge : there + nudge);
      place = there + kPastASurface * direction;
      left -= hit->distance + kPastASurface;
    }
  }

  const sensing::RayScene& rays_;
  OccupancyMap& map_;
  const double height_;
};

}  // namespace

base::Result<std::string> WorldOfMap(const OccupancyMap& map, const std::string& name,
                                     double height) {
  const std::vector<CellBox> boxes = BoxesOf(map);
  if (boxes.size() > kMaxBoxes) {
    return base::Fail(
        base::ErrorCode::kInvalidArgument,
        fmt::format("the walls of the map need {} boxes; a world can have at most {}. Smooth or "
                    "scale down the image",
                    boxes.size(), kMaxBoxes));
  }
  std::string sdf = fmt::format(
      "<?xml version=\"1.0\"?>\n<sdf version=\"1.9\">\n  <world name=\"{}\">\n"
      "    <physics name=\"steps\" type=\"ignored\"><max_step_size>0.01</max_step_size>"
      "<real_time_factor>1</real_time_factor></physics>\n"
      "    <include><uri>model://sun</uri></include>\n"
      "    <include><uri>model://ground_plane</uri></include>\n"
      "    <model name=\"walls\">\n      <static>true</static>\n"
      "      <pose>{} {} 0 0 0 {}</pose>\n      <link name=\"walls\">\n",
      XmlName(name), map.origin_x, map.origin_y, map.origin_yaw);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const CellBox& box = boxes[i];
    const std::string geometry = fmt::format(
        "<pose>{:.6g} {:.6g} {:.6g} 0 0 0</pose><geometry><box><size>{:.6g} {:.6g} {:.6g}</size>"
        "</box></geometry>",
        (box.x + box.width / 2.0) * map.resolution, (box.y + box.height / 2.0) * map.resolution,
        height / 2, box.width * map.resolution, box.height * map.resolution, height);
    sdf += fmt::format(
        "        <collision name=\"wall_{0}\">{1}</collision>\n"
        "        <visual name=\"wall_{0}\">{1}</visual>\n",
        i, geometry);
  }
  return sdf + "      </link>\n    </model>\n  </world>\n</sdf>\n";
}

base::Result<OccupancyMap> MapOfWorld(const model::WorldDescription& world,
                                      const SliceOptions& options) {
  const auto snapshot = std::make_shared<const world::Snapshot>(WithoutRobots(world));
  const geometry::Bounds extent = Extent(snapshot);
  const auto nothing_there = [&] {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      fmt::format("there is nothing in the world at a height of {} m; choose "
                                  "another height with --height",
                                  options.height),
                      world.source);
  };
  const bool reaches = extent.min.z <= options.height && options.height <= extent.max.z;
  if (!(extent.min.x <= extent.max.x) || !reaches) return nothing_there();
  OccupancyMap map;
  map.resolution = options.resolution;
  map.origin_x = std::floor((extent.min.x - options.margin) / map.resolution) * map.resolution;
  map.origin_y = std::floor((extent.min.y - options.margin) / map.resolution) * map.resolution;
  const double width = std::ceil((extent.max.x + options.margin - map.origin_x) / map.resolution);
  const double height = std::ceil((extent.max.y + options.margin - map.origin_y) / map.resolution);
  if (!(width * height <= kMaxCells)) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      fmt::format("the map would have {} by {} cells, and at most {} million are "
                                  "made; choose a coarser --resolution",
                                  width, height, kMaxCells / 1e6),
                      world.source);
  }
  map.width = static_cast<int>(width), map.height = static_cast<int>(height);
  map.cells.assign(static_cast<std::size_t>(width * height), Cell::kFree);
  sensing::RaySceneCache cache;
  const auto scene = cache.At(snapshot);
  Slicer(*scene, map, options.height).Run();
  if (std::count(map.cells.begin(), map.cells.end(), Cell::kOccupied) == 0) return nothing_there();
  return map;
}

}  // namespace gsv::reality
