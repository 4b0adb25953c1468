#include "gsv/view/framing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "gsv/base/sorting.h"
#include "gsv/geometry/box_corners.h"

namespace gsv::view {
namespace {

using geometry::Bounds;
using geometry::Pose;
using geometry::Vector3;

constexpr double kBoundless = std::numeric_limits<double>::infinity();
// A body is too far away if its distance from the middle exceeds kFarMetres + kFarRadii * R. R is
// the radius of the sphere that contains all nearer bodies. Such a body is not shown.
constexpr double kFarRadii = 20, kFarMetres = 100;
// A body counts as ground if it is flat and large: its height is at most kFlat times its width, and
// its area is at least kMuchMore times the area of the other bodies.
constexpr double kFlat = 0.02, kMuchMore = 4;

Bounds Nothing() {
  return {{kBoundless, kBoundless, kBoundless}, {-kBoundless, -kBoundless, -kBoundless}};
}

void Grow(Bounds& bounds, const Vector3& p) {
  bounds.min = {std::min(bounds.min.x, p.x), std::min(bounds.min.y, p.y),
                std::min(bounds.min.z, p.z)};
  bounds.max = {std::max(bounds.max.x, p.x), std::max(bounds.max.y, p.y),
                std::max(bounds.max.z, p.z)};
}

void Grow(Bounds& bounds, const Bounds& other) {
  Grow(bounds, other.min);
  Grow(bounds, other.max);
}

// The bounding box of one visual, in the world.
struct Seen {
  std::vector<Vector3> corners;
  Bounds bounds = Nothing();

  bool is_flat() const {
    const Vector3 size = bounds.max - bounds.min;
    return size.z <= kFlat * std::max(size.x, size.y);
  }
};

double AreaOf(const Bounds& bounds) {
  const Vector3 size = bounds.max - bounds.min;
  return size.x > 0 && size.y > 0 ? size.x * size.y : 0;
}

std::vector<Seen> SeenOf(const world::Snapshot& snapshot, int body) {
  std::vector<Seen> seen;
  const std::vector<Pose> world_from_link = world::LinkPoses(snapshot, body);
  const model::Model& model = *snapshot.layout->bodies[static_cast<std::size_t>(body)].model;
  for (std::size_t link = 0; link < model.links.size(); ++link) {
    for (const model::Visual& visual : model.links[link].visuals) {
      if (std::holds_alternative<geometry::Plane>(visual.shape)) continue;
      const Pose world_from_visual = world_from_link[link] * visual.link_from_visual;
      Seen each;
      for (const Vector3& corner : geometry::CornersOf(geometry::BoundsOf(visual.shape))) {
        each.corners.push_back(world_from_visual * corner);
        Grow(each.bounds, each.corners.back());
      }
      seen.push_back(std::move(each));
    }
  }
  return seen;
}

struct SeenBody {
  std::vector<Seen> visuals;
  Bounds bounds = Nothing();

  Vector3 centre() const { return (bounds.min + bounds.max) * 0.5; }
  double radius() const { return Norm(bounds.max - bounds.min) / 2; }
};

// Returns the median of the bodies' centres for each axis, or the origin for fewer than three
// bodies.
Vector3 MiddleOf(const std::vector<SeenBody>& bodies) {
  if (bodies.size() < 3) return {};
  const auto median = [&](double Vector3::*axis) {
    std::vector<double> values;
    for (const SeenBody& body : bodies) values.push_back(body.centre().*axis);
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
  };
  return {median(&Vector3::x), median(&Vector3::y), median(&Vector3::z)};
}

void DropFarAway(std::vector<SeenBody>& bodies) {
  const Vector3 middle = MiddleOf(bodies);
  const auto distance = [&](const SeenBody& body) { return Norm(body.centre() - middle); };
  base::Sort(bodies,
             [&](const SeenBody& a, const SeenBody& b) { return distance(a) < distance(b); });
  double radius = 0;  // radius of the sphere about `middle` that contains the bodies so far
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const double nearest = distance(bodies[i]) - bodies[i].radius();
    // A body is left out only if at least half of all bodies are nearer.
    if (nearest > kFarRadii * radius + kFarMetres && 2 * i >= bodies.size()) {
      bodies.resize(i);
      return;
    }
    radius = std::max(radius, distance(bodies[i]) + bodies[i].radius());
  }
}

// Returns the bodies without the ground. If there is only ground, returns the ground.
std::vector<const Seen*> WithoutGround(const std::vector<SeenBody>& bodies) {
  std::vector<const Seen*> all, standing;
  Bounds of_all = Nothing(), of_standing = Nothing();
  for (const SeenBody& body : bodies) {
    for (const Seen& seen : body.visuals) {
      all.push_back(&seen);
      Grow(of_all, seen.bounds);
      if (seen.is_flat()) continue;
      standing.push_back(&seen);
      Grow(of_standing, seen.bounds);
    }
  }
  const bool is_ground_large = AreaOf(of_all) > kMuchMore * AreaOf(of_standing);
  return standing.empty() || !is_ground_large ? all : standing;
}

}  // namespace

std::vector<Vector3> CornersToShow(const world::Snapshot& snapshot) {
  std::vector<SeenBody> bodies;
  for (int body = 0; body < static_cast<int>(snapshot.layout->bodies.size()); ++body) {
    SeenBody seen{SeenOf(snapshot, body)};
    for (const Seen& each : seen.visuals) Grow(seen.bounds, each.bounds);
    if (!seen.visuals.empty()) bodies.push_back(std::move(seen));
  }
  DropFarAway(bodies);
  std::vector<Vector3> corners;
  for (const Seen* seen : WithoutGround(bodies)) {
    corners.insert(corners.end(), seen->corners.begin(), seen->corners.end());
  }
  if (corners.empty()) corners = {{-1, -1, 0}, {1, 1, 1}};
  return corners;
}

rendering::CameraView Overview(const std::vector<Vector3>& corners, int width, int height,
                               const OverviewSide& side) {
  constexpr double kMargin = 1.05;
  constexpr double kFieldOfView = 0.8;
  constexpr double kMaxCoordinate = 1e6;  // m; the renderer's maximum
  const geometry::Quaternion turn = geometry::FromRollPitchYaw({0, side.elevation, side.azimuth});
  const double across = std::tan(kFieldOfView / 2) / kMargin, up = across * height / width;
  constexpr double kEndless = std::numeric_limits<double>::infinity();
  Vector3 low{kEndless, kEndless, kEndless}, high{-kEndless, -kEndless, -kEndless};
  std::vector<Vector3> turned;
  for (const Vector3& corner : corners) {
    const Vector3 p = geometry::Inverse(turn) * corner;
    turned.push_back(p);
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const Vector3 middle = (low + high) * 0.5;
  double back = 0;  // distance of the camera from the centre
  for (const Vector3& p : turned) {
    const Vector3 q = p - middle;
    back = std::max({back, std::abs(q.y) / across - q.x, std::abs(q.z) / up - q.x});
  }
  const double whole = back;
  back /= side.zoom;
  rendering::CameraParameters camera;
  camera.width = width;
  camera.height = height;
  camera.horizontal_fov = kFieldOfView;
  camera.far = std::min(10 * std::max(back, whole) + 10, kMaxCoordinate);
  camera.near = std::clamp(1e-2 * back, 1e-3, camera.far / 10);
  return {{turn * (middle - Vector3{back, 0, 0}), turn}, camera};
}

}  // namespace gsv::view
