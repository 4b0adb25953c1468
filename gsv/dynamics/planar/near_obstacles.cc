#include "gsv/dynamics/planar/near_obstacles.h"

#include <algorithm>

#include "gsv/dynamics/shapes/time_of_impact.h"

namespace gsv::dynamics {
namespace {

// Margin for rounding errors, m: far larger than these errors, and far smaller than distances that
// matter.
constexpr double kRounding = 1e-6;

}  // namespace

void NearObstacles::Reset(std::size_t chunks) {
  clearances_.assign(scene_.movers().size(), {});
  chunks_.resize(chunks);
}

void NearObstacles::Clear(std::size_t chunk) {
  chunks_[chunk].near.clear();
  chunks_[chunk].touching.clear();
}

void NearObstacles::Find(std::size_t chunk, std::uint32_t mover, const geometry::PlanarPosition& at,
                         double travel) {
  const double within = travel + kTouchGap;
  const double radius = scene_.footprint(mover).radius;
  if (scene_.has_dynamic()) {
    Search(chunks_[chunk], mover, at, within, radius + within + kRounding, true);
  }
  if (IsClear(mover, at, travel)) return;
  // This distance is large enough: if the search finds no obstacle within it, IsClear() is true
  // after the search.
  const double look = radius + std::max(within + 2 * kRounding, kLookAround);
  const double nearest = Search(chunks_[chunk], mover, at, within, look, false);
  clearances_[mover] = {{at.x, at.y}, nearest - radius - kRounding};
}

double NearObstacles::Search(Chunk& chunk, std::uint32_t m, const geometry::PlanarPosition& at,
                             double within, double look, bool dynamic) const {
  const Mover& mover = scene_.movers()[m];
  const Footprint& footprint = scene_.kind(mover).footprint;
  const Vector2 origin{at.x, at.y};
  double nearest = look;
  ConvexPiece placed;
  for (std::uint32_t p = 0; p < footprint.pieces.size(); ++p) {
    const int level = scene_.level(mover, p);
    if (level < 0) continue;
    const Footprint::Piece& piece = footprint.pieces[p];
    const Vector2 centre = PointAt(piece.centre, at);
    const ObstacleField& field = dynamic ? scene_.dynamic_field(level) : scene_.field(level);
    bool is_placed = false;
    field.ForEachNear(origin, look, [&](std::uint32_t index) {
      const Obstacle& obstacle = field[index];
      if (!Meet(obstacle.filter, piece.filter)) return;
      const double from_origin = DistanceTo(obstacle.shape, origin);
      nearest = std::min(nearest, from_origin);
      if (from_origin > footprint.radius + within + kRounding) return;
      const double from_centre =
          centre == origin ? from_origin : DistanceTo(obstacle.shape, centre);
      if (from_centre > piece.radius + within) return;
      if (!is_placed) Place(piece.shape, at, placed);
      is_placed = true;
      const Separation separation = Separate(placed, obstacle.shape);
      if (separation.distance > within) return;
      chunk.near.push_back({m, p, index, &field, at, separation});
      if (separation.distance <= kTouchGap) chunk.touching.push_back({mover.body, obstacle.body});
    });
  }
  return nearest;
}

Separation NearObstacles::SeparationAt(const Near& near, const geometry::PlanarPosition& at) const {
  if (at == near.found_at) return near.separation;
  ConvexPiece placed;
  Place(PieceOf(near).shape, at, placed);
  return Separate(placed, ObstacleOf(near).shape);
}

void NearObstacles::Stop(std::size_t chunk, std::span<const geometry::PlanarPosition> starts,
                         std::span<const geometry::Twist> twists, std::span<double> times,
                         std::span<Vector2> normals) const {
  for (const Near& near : chunks_[chunk].near) {
    double& time = times[near.mover];
    if (time <= 0) continue;
    const geometry::PlanarPosition& start = starts[near.mover];
    const auto impact = FindImpact(MovingPiece{&PieceOf(near).shape, start, twists[near.mover]},
                                   ObstacleOf(near).shape, time, SeparationAt(near, start).normal);
    if (!impact) continue;
    time = impact->time;
    normals[near.mover] = impact->normal;
  }
}

void NearObstacles::AddTouching(std::vector<BodyPair>& touching) const {
  for (const Chunk& chunk : chunks_) {
    touching.insert(touching.end(), chunk.touching.begin(), chunk.touching.end());
  }
}

void NearObstacles::Collect(std::span<const geometry::PlanarPosition> positions,
                            ContactCollector& contacts) const {
  for (const Chunk& chunk : chunks_) {
    for (const Near& near : chunk.near) {
      const Interval heights = PieceOf(near).heights;
      contacts.Offer({scene_.movers()[near.mover].body, ObstacleOf(near).body},
                     SeparationAt(near, positions[near.mover]),
                     scene_.height(near.mover) + (heights.low + heights.high) / 2);
    }
  }
}

}  // namespace gsv::dynamics
