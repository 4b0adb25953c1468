#include "gsv/dynamics/planar_solver.h"

#include <algorithm>
#include <tuple>

namespace gsv::dynamics {
namespace {

void PlaceAt(const ConvexPiece& piece, const PlanarPosition& at, ConvexPiece& placed) {
  Place(piece, at.x, at.y, at.cosine, at.sine, placed);
}

bool Moves(const Twist& twist) { return twist.x != 0 || twist.y != 0 || twist.angular != 0; }

Vector2 PointAt(Vector2 point, const PlanarPosition& at) {
  return {at.x + (at.cosine * point.x - at.sine * point.y),
          at.y + (at.sine * point.x + at.cosine * point.y)};
}

// Pieces that share no more than this do not meet.
constexpr double kSameHeight = 1e-9;

// The heights that both reach; upside down if there are none.
Interval SharedHeights(const Footprint::Piece& a, double height_a, const Footprint::Piece& b,
                       double height_b) {
  return {std::max(a.heights.low + height_a, b.heights.low + height_b),
          std::min(a.heights.high + height_a, b.heights.high + height_b)};
}

}  // namespace

void PlanarSolver::Begin(std::span<const PlanarPosition> starts, std::span<const double> travels) {
  touched_.clear();
  FindNearObstacles(starts, travels);
  FindNearPairs(starts, travels);
  std::sort(touched_.begin(), touched_.end());
}

void PlanarSolver::FindNearObstacles(std::span<const PlanarPosition> starts,
                                     std::span<const double> travels) {
  near_obstacles_.clear();
  ConvexPiece placed;
  for (std::uint32_t m = 0; m < starts.size(); ++m) {
    const Mover& mover = scene_.movers()[m];
    const PlanarPosition& at = starts[m];
    const double within = travels[m] + kTouchGap;
    for (std::uint32_t p = 0; p < mover.levels.size(); ++p) {
      const int level = mover.levels[p];
      if (level < 0) continue;
      const Footprint::Piece& piece = mover.footprint->pieces[p];
      const Vector2 centre = PointAt(piece.centre, at);
      const ObstacleField& field = scene_.field(level);
      bool is_placed = false;
      field.ForEachNear(centre, piece.radius + within, [&](std::uint32_t index) {
        if (DistanceTo(field[index].shape, centre) > piece.radius + within) return;
        if (!is_placed) PlaceAt(piece.shape, at, placed);
        is_placed = true;
        const double distance = Separate(placed, field[index].shape).distance;
        if (distance <= within) near_obstacles_.push_back({m, p, index, level});
        if (distance <= kTouchGap) touched_.push_back({mover.body, field[index].body});
      });
    }
  }
}

void PlanarSolver::FindNearPairs(std::span<const PlanarPosition> starts,
                                 std::span<const double> travels) {
  centres_.resize(starts.size());
  radii_.resize(starts.size());
  for (std::size_t m = 0; m < starts.size(); ++m) {
    centres_[m] = {starts[m].x, starts[m].y};
    radii_[m] = scene_.movers()[m].footprint->radius + travels[m] + kTouchGap;
  }
  near_pairs_.clear();
  near_pieces_.clear();
  ConvexPiece placed_p, placed_q;
  for (const auto& [first, second] : pair_finder_.Find(centres_, radii_)) {
    const double within = travels[first] + travels[second] + kTouchGap;
    const Mover& a = scene_.movers()[first];
    const Mover& b = scene_.movers()[second];
    const auto begin = static_cast<std::uint32_t>(near_pieces_.size());
    bool touched = false;
    for (std::uint32_t p = 0; p < a.footprint->pieces.size(); ++p) {
      const Footprint::Piece& piece_p = a.footprint->pieces[p];
      const Vector2 centre_p = PointAt(piece_p.centre, starts[first]);
      for (std::uint32_t q = 0; q < b.footprint->pieces.size(); ++q) {
        const Footprint::Piece& piece_q = b.footprint->pieces[q];
        const Interval shared =
            SharedHeights(piece_p, scene_.height(first), piece_q, scene_.height(second));
        if (shared.high - shared.low <= kSameHeight) continue;
        const Vector2 d = PointAt(piece_q.centre, starts[second]) - centre_p;
        const double reach = piece_p.radius + piece_q.radius + within;
        if (Dot(d, d) > reach * reach) continue;
        PlaceAt(piece_q.shape, starts[second], placed_q);
        if (DistanceTo(placed_q, centre_p) > piece_p.radius + within) continue;
        PlaceAt(piece_p.shape, starts[first], placed_p);
        const double distance = Separate(placed_p, placed_q).distance;
        if (distance <= within) near_pieces_.push_back({p, q});
        touched = touched || distance <= kTouchGap;
      }
    }
    const auto end = static_cast<std::uint32_t>(near_pieces_.size());
    if (end > begin) near_pairs_.push_back({first, second, begin, end});
    if (touched) touched_.push_back({a.body, b.body});
  }
}

void PlanarSolver::Run(std::span<const PlanarPosition> starts, std::span<const Twist> twists,
                       std::span<double> times, std::span<Vector2> normals) {
  for (std::size_t m = 0; m < times.size(); ++m) {
    if (!Moves(twists[m])) times[m] = 0;
  }
  const Motions motions{starts, twists, times};
  StopAtObstacles(motions, times, normals);
  StopAtEachOther(motions, times, normals);
}

void PlanarSolver::StopAtObstacles(const Motions& motions, std::span<double> times,
                                   std::span<Vector2> normals) {
  for (const NearObstacle& near : near_obstacles_) {
    double& time = times[near.mover];
    if (time <= 0) continue;
    const ConvexPiece& piece = scene_.movers()[near.mover].footprint->pieces[near.piece].shape;
    const auto impact =
        FindImpact(MovingPiece{&piece, motions.starts[near.mover], motions.twists[near.mover]},
                   scene_.field(near.level)[near.obstacle].shape, time);
    if (!impact) continue;
    time = impact->time;
    normals[near.mover] = impact->normal;
  }
}

void PlanarSolver::StopAtEachOther(const Motions& motions, std::span<double> times,
                                   std::span<Vector2> normals) {
  if (near_pairs_.empty()) return;
  changed_.assign(times.size(), 1);
  next_times_.assign(times.begin(), times.end());
  for (int round = 0;; ++round) {
    bool any = false;
    next_changed_.assign(times.size(), 0);
    const auto stop = [&](std::uint32_t m, double time, Vector2 normal) {
      if (round >= kRounds) time = 0;
      if (time >= next_times_[m]) return;
      next_times_[m] = time;
      normals[m] = normal;
      next_changed_[m] = 1;
      any = true;
    };
    for (const NearPair& pair : near_pairs_) {
      if (!changed_[pair.first] && !changed_[pair.second]) continue;
      const std::optional<Impact> impact = PairImpact(motions, pair);
      if (!impact) continue;
      if (impact->first_approaches) stop(pair.first, impact->time, impact->normal);
      if (impact->second_approaches) stop(pair.second, impact->time, -1.0 * impact->normal);
    }
    if (!any) return;
    std::copy(next_times_.begin(), next_times_.end(), times.begin());
    changed_.swap(next_changed_);
  }
}

std::optional<Impact> PlanarSolver::PairImpact(const Motions& motions, const NearPair& pair) const {
  const double first_time = motions.times[pair.first], second_time = motions.times[pair.second];
  const double both = std::min(first_time, second_time), end = std::max(first_time, second_time);
  MovingPiece a{nullptr, motions.starts[pair.first], motions.twists[pair.first]};
  MovingPiece b{nullptr, motions.starts[pair.second], motions.twists[pair.second]};
  std::optional<Impact> impact;
  if (both > 0) impact = FirstImpact(pair, a, b, both);
  if (impact || end <= both) return impact;
  // One has come to its end and stands; the other goes on.
  a.start = Advance(a.start, a.twist, both);
  b.start = Advance(b.start, b.twist, both);
  (first_time <= both ? a : b).twist = Twist{};
  impact = FirstImpact(pair, a, b, end - both);
  if (impact) impact->time += both;
  return impact;
}

std::optional<Impact> PlanarSolver::FirstImpact(const NearPair& pair, MovingPiece a, MovingPiece b,
                                                double end) const {
  std::optional<Impact> first;
  for (std::uint32_t i = pair.begin_piece; i < pair.end_piece; ++i) {
    a.piece = &PieceOf(pair.first, near_pieces_[i].first).shape;
    b.piece = &PieceOf(pair.second, near_pieces_[i].second).shape;
    if (const auto impact = FindImpact(a, b, end)) {
      first = impact;
      end = impact->time;
    }
  }
  return first;
}

std::vector<world::Contact> PlanarSolver::FindContacts(std::span<const PlanarPosition> positions,
                                                       double gap) {
  std::vector<world::Contact> contacts;
  ConvexPiece placed_a, placed_b;
  const auto add = [&](int first, int second, const ConvexPiece& other, double height) {
    const Separation separation = Separate(placed_a, other);
    if (separation.distance > gap) return;
    contacts.push_back({first,
                        second,
                        {separation.point.x, separation.point.y, height},
                        {separation.normal.x, separation.normal.y, 0},
                        -separation.distance,
                        false});
  };
  for (const NearObstacle& near : near_obstacles_) {
    const Footprint::Piece& piece = PieceOf(near.mover, near.piece);
    const Obstacle& obstacle = scene_.field(near.level)[near.obstacle];
    PlaceAt(piece.shape, positions[near.mover], placed_a);
    add(scene_.movers()[near.mover].body, obstacle.body, obstacle.shape,
        scene_.height(near.mover) + (piece.heights.low + piece.heights.high) / 2);
  }
  for (const NearPair& pair : near_pairs_) {
    for (std::uint32_t i = pair.begin_piece; i < pair.end_piece; ++i) {
      const Footprint::Piece& p = PieceOf(pair.first, near_pieces_[i].first);
      const Footprint::Piece& q = PieceOf(pair.second, near_pieces_[i].second);
      PlaceAt(p.shape, positions[pair.first], placed_a);
      PlaceAt(q.shape, positions[pair.second], placed_b);
      const Interval shared =
          SharedHeights(p, scene_.height(pair.first), q, scene_.height(pair.second));
      add(scene_.movers()[pair.first].body, scene_.movers()[pair.second].body, placed_b,
          (shared.low + shared.high) / 2);
    }
  }
  // One contact for each pair of bodies: the deepest.
  std::stable_sort(
      contacts.begin(), contacts.end(), [](const world::Contact& a, const world::Contact& b) {
        return std::tie(a.first, a.second, b.depth) < std::tie(b.first, b.second, a.depth);
      });
  const auto same_pair = [](const world::Contact& a, const world::Contact& b) {
    return a.first == b.first && a.second == b.second;
  };
  contacts.erase(std::unique(contacts.begin(), contacts.end(), same_pair), contacts.end());
  MarkBegan(contacts);
  return contacts;
}

void PlanarSolver::MarkBegan(std::vector<world::Contact>& contacts) const {
  for (world::Contact& contact : contacts) {
    contact.depth = std::max(contact.depth, 0.0);
    contact.began = !std::binary_search(touched_.begin(), touched_.end(),
                                        BodyPair{contact.first, contact.second});
  }
}

}  // namespace gsv::dynamics
