#include "gsv/dynamics/rigid/mesh_points.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace gsv::dynamics {

using geometry::Vector3;

void MeshPoints::Add(const Vector3& on_mesh, const Vector3& normal, double distance) {
  constexpr double kSameDirection = 1 - 1e-6;
  // Choose() removes duplicates too.
  constexpr std::size_t kMaxCompared = 4 * kMaxPoints;
  const std::size_t end = std::min(points_.size(), begin_ + kMaxCompared);
  for (std::size_t i = begin_; i < end; ++i) {
    const Vector3 between = points_[i].on_second - on_mesh;
    if (Dot(between, between) < near_ * near_ && Dot(points_[i].normal, normal) > kSameDirection)
      return;
  }
  points_.push_back({on_mesh, normal, distance});
}

// Returns the distance between two points, for the choice of points that are far apart. A
// difference of the normals also counts as a distance: the angle between them (rad) times the
// radius (m).
double MeshPoints::DistanceOf(const TouchPoint& a, const TouchPoint& b) const {
  const Vector3 between = a.on_second - b.on_second, turn = radius_ * (a.normal - b.normal);
  return std::sqrt(Dot(between, between) + Dot(turn, turn));
}

void MeshPoints::Choose() {
  constexpr double kLeast = 0.01;  // fraction of the radius
  const auto begin = points_.begin() + static_cast<std::ptrdiff_t>(begin_);
  std::sort(begin, points_.end(), [](const TouchPoint& a, const TouchPoint& b) {
    const Vector3 &p = a.on_second, &q = b.on_second, &m = a.normal, &n = b.normal;
    return std::tie(a.distance, p.x, p.y, p.z, m.x, m.y, m.z) <
           std::tie(b.distance, q.x, q.y, q.z, n.x, n.y, n.z);
  });
  std::vector<double> scores;
  for (auto point = begin; point != points_.end(); ++point) {
    const double gap = point->distance - begin->distance;
    scores.push_back(DistanceOf(*begin, *point) - std::sqrt(2 * radius_ * gap));
  }
  std::vector<TouchPoint> chosen{*begin};
  while (chosen.size() < kMaxPoints) {
    const auto best = std::max_element(scores.begin(), scores.end());
    if (!(*best > kLeast * radius_)) break;
    chosen.push_back(begin[best - scores.begin()]);
    for (std::size_t i = 0; i < scores.size(); ++i) {
      const TouchPoint& point = begin[static_cast<std::ptrdiff_t>(i)];
      const double gap = point.distance - begin->distance;
      scores[i] =
          std::min(scores[i], DistanceOf(chosen.back(), point) - std::sqrt(2 * radius_ * gap));
    }
  }
  points_.erase(begin, points_.end());
  points_.insert(points_.end(), chosen.begin(), chosen.end());
}

void MeshPoints::Finish(const PlacedPiece& mesh) {
  if (points_.size() - begin_ > kMaxPoints) Choose();
  for (std::size_t i = begin_; i < points_.size(); ++i) {
    points_[i].on_second = mesh.position + mesh.rotation * points_[i].on_second;
    points_[i].normal = mesh.rotation * points_[i].normal;
  }
}

}  // namespace gsv::dynamics
