#include "gsv/dynamics/planar/mover_collisions.h"

#include <algorithm>

namespace gsv::dynamics {
namespace {

// Distance (m) that a slow mover may move before the search for candidates is repeated. Fast movers
// may move further. With a larger value, each step has more candidates to check.
constexpr double kRoom = 0.25;

// Number of pairs that one thread checks at a time. If there are no more pairs than this, one
// thread checks them all, because a second thread would save no time.
constexpr std::size_t kPairsAtOnce = 32;

// Pieces whose height ranges overlap by no more than this (m) do not touch.
constexpr double kSameHeight = 1e-9;

// Margin for rounding errors, m: far larger than these errors, and far smaller than distances that
// matter.
constexpr double kPairRounding = 1e-6;

// The range of heights that two pieces share; empty (low above high) if they share none.
Interval SharedHeights(const Footprint::Piece& a, double height_a, const Footprint::Piece& b,
                       double height_b) {
  return {std::max(a.heights.low + height_a, b.heights.low + height_b),
          std::min(a.heights.high + height_a, b.heights.high + height_b)};
}

}  // namespace

void MoverCollisions::Reset() {
  rooms_.assign(scene_.movers().size(), {});
  candidates_.clear();
  marked_.clear();
  Clear();
}

void MoverCollisions::Clear() {
  pairs_.clear();
  pieces_.clear();
  touching_.clear();
}

void MoverCollisions::FindCandidates(std::span<const geometry::PlanarPosition> starts,
                                     std::span<const double> travels) {
  centres_.resize(starts.size());
  radii_.resize(starts.size());
  for (std::size_t m = 0; m < starts.size(); ++m) {
    rooms_[m] = {{starts[m].x, starts[m].y}, std::max(kRoom, 2 * travels[m])};
    centres_[m] = rooms_[m].centre;
    radii_[m] = scene_.footprint(m).radius + rooms_[m].radius + kPairRounding;
  }
  const auto& found = finder_.Find(centres_, radii_);
  candidates_.assign(found.begin(), found.end());
}

void MoverCollisions::Find(std::span<const geometry::PlanarPosition> starts,
                           std::span<const double> travels) {
  FindAmong(candidates_, starts, travels);
}

void MoverCollisions::FindMarked(std::span<const geometry::PlanarPosition> starts,
                                 std::span<const double> travels) {
  FindAmong(marked_, starts, travels);
}

void MoverCollisions::FindAmong(std::span<const BroadPhase::Pair> pairs,
                                std::span<const geometry::PlanarPosition> starts,
                                std::span<const double> travels) {
  Clear();
  for (const auto& [first, second] : pairs) {
    AddIfNear(first, second, starts, travels[first] + travels[second] + kTouchGap);
  }
}

void MoverCollisions::MarkNear(std::span<const geometry::PlanarPosition> starts,
                               std::span<const double> travels, std::span<std::uint8_t> is_near) {
  marked_.clear();
  for (const BroadPhase::Pair& pair : candidates_) {
    const double within = travels[pair.first] + travels[pair.second] + kTouchGap;
    if (!AreNear(pair.first, pair.second, starts, within)) continue;
    is_near[pair.first] = is_near[pair.second] = 1;
    marked_.push_back(pair);
  }
}

bool MoverCollisions::AreNear(std::uint32_t first, std::uint32_t second,
                              std::span<const geometry::PlanarPosition> starts,
                              double within) const {
  const Vector2 apart{starts[second].x - starts[first].x, starts[second].y - starts[first].y};
  const double furthest =
      scene_.footprint(first).radius + scene_.footprint(second).radius + within + kPairRounding;
  return Dot(apart, apart) <= furthest * furthest;
}

void MoverCollisions::FindOf(std::uint32_t mover, std::span<const std::uint32_t> others,
                             std::span<const geometry::PlanarPosition> starts) {
  Clear();
  for (const std::uint32_t other : others) {
    AddIfNear(std::min(mover, other), std::max(mover, other), starts, kTouchGap);
  }
}

void MoverCollisions::AddIfNear(std::uint32_t first, std::uint32_t second,
                                std::span<const geometry::PlanarPosition> starts, double within) {
  const geometry::PlanarPosition &start_a = starts[first], &start_b = starts[second];
  const Footprint &a = scene_.footprint(first), &b = scene_.footprint(second);
  if (!AreNear(first, second, starts, within)) return;
  const auto begin = static_cast<std::uint32_t>(pieces_.size());
  bool touches = false;
  ConvexPiece placed_p, placed_q;
  for (std::uint32_t p = 0; p < a.pieces.size(); ++p) {
    const Footprint::Piece& piece_p = a.pieces[p];
    const Vector2 centre_p = PointAt(piece_p.centre, start_a);
    for (std::uint32_t q = 0; q < b.pieces.size(); ++q) {
      const Footprint::Piece& piece_q = b.pieces[q];
      if (!Meet(piece_p.filter, piece_q.filter)) continue;
      const Interval shared =
          SharedHeights(piece_p, scene_.height(first), piece_q, scene_.height(second));
      if (shared.high - shared.low <= kSameHeight) continue;
      const Vector2 d = PointAt(piece_q.centre, start_b) - centre_p;
      const double reach = piece_p.radius + piece_q.radius + within;
      if (Dot(d, d) > reach * reach) continue;
      Place(piece_q.shape, start_b, placed_q);
      if (DistanceTo(placed_q, centre_p) > piece_p.radius + within) continue;
      Place(piece_p.shape, start_a, placed_p);
      const Separation separation = Separate(placed_p, placed_q);
      if (separation.distance > within) continue;
      pieces_.push_back({p, q, start_a, start_b, separation});
      touches = touches || separation.distance <= kTouchGap;
    }
  }
  const auto end = static_cast<std::uint32_t>(pieces_.size());
  if (end > begin) pairs_.push_back({first, second, begin, end});
  if (touches) touching_.push_back({scene_.movers()[first].body, scene_.movers()[second].body});
}

void MoverCollisions::StopIn(base::ThreadTeam* team,
                             std::span<const geometry::PlanarPosition> starts,
                             std::span<const geometry::Twist> twists, std::span<double> times,
                             std::span<Vector2> normals) {
  outcomes_.resize(times.size());
  for (const MoverPair& pair : pairs_) {
    for (const std::uint32_t m : {pair.first, pair.second}) outcomes_[m] = {times[m], 0, 0};
  }
  const Motions motions{starts, twists, times};
  bool any = !pairs_.empty();
  for (int round = 0; any; ++round) {
    FindImpacts(team, motions, round);
    any = false;
    const auto stop = [&](std::uint32_t m, double time, Vector2 normal) {
      if (round >= kIterations) time = 0;
      if (time >= outcomes_[m].time) return;
      outcomes_[m].time = time;
      outcomes_[m].new_since = round + 1;
      normals[m] = normal;
      any = true;
    };
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      const std::optional<Impact>& impact = impacts_[i];
      if (!impact) continue;
      if (impact->first_approaches) stop(pairs_[i].first, impact->time, impact->normal);
      if (impact->second_approaches) stop(pairs_[i].second, impact->time, -1.0 * impact->normal);
    }
    for (const MoverPair& pair : pairs_) {
      for (const std::uint32_t m : {pair.first, pair.second}) {
        times[m] = outcomes_[m].time;
        outcomes_[m].since = outcomes_[m].new_since;
      }
    }
  }
}

// Finds the impact of each pair in which a mover has a new stop time in this iteration.
void MoverCollisions::FindImpacts(base::ThreadTeam* team, const Motions& motions, int round) {
  impacts_.resize(pairs_.size());
  const auto find = [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const MoverPair& pair = pairs_[i];
      const bool is_new =
          outcomes_[pair.first].since == round || outcomes_[pair.second].since == round;
      impacts_[i] = is_new ? PairImpact(motions, pair) : std::nullopt;
    }
  };
  if (team != nullptr) {
    team->ParallelFor(pairs_.size(), kPairsAtOnce, find);
  } else {
    find(0, pairs_.size());
  }
}

std::optional<Impact> MoverCollisions::PairImpact(const Motions& motions,
                                                  const MoverPair& pair) const {
  const double first_time = motions.times[pair.first], second_time = motions.times[pair.second];
  const double both = std::min(first_time, second_time), end = std::max(first_time, second_time);
  MovingPiece a{nullptr, motions.starts[pair.first], motions.twists[pair.first]};
  MovingPiece b{nullptr, motions.starts[pair.second], motions.twists[pair.second]};
  std::optional<Impact> impact;
  if (both > 0) impact = FirstImpact(pair, a, b, both);
  if (impact || end <= both) return impact;
  // One of the two movers has stopped at the end of its motion. The other mover continues.
  a.start = Advance(a.start, a.twist, both);
  b.start = Advance(b.start, b.twist, both);
  (first_time <= both ? a : b).twist = geometry::Twist{};
  impact = FirstImpact(pair, a, b, end - both);
  if (impact) impact->time += both;
  return impact;
}

Separation MoverCollisions::SeparationAt(const MoverPair& pair, const PiecePair& pieces,
                                         const geometry::PlanarPosition& first_at,
                                         const geometry::PlanarPosition& second_at) const {
  if (first_at == pieces.first_found_at && second_at == pieces.second_found_at) {
    return pieces.separation;
  }
  ConvexPiece first, second;
  Place(scene_.footprint(pair.first).pieces[pieces.first].shape, first_at, first);
  Place(scene_.footprint(pair.second).pieces[pieces.second].shape, second_at, second);
  return Separate(first, second);
}

std::optional<Impact> MoverCollisions::FirstImpact(const MoverPair& pair, MovingPiece a,
                                                   MovingPiece b, double end) const {
  std::optional<Impact> first;
  for (std::uint32_t i = pair.begin_piece; i < pair.end_piece; ++i) {
    const PiecePair& pieces = pieces_[i];
    a.piece = &scene_.footprint(pair.first).pieces[pieces.first].shape;
    b.piece = &scene_.footprint(pair.second).pieces[pieces.second].shape;
    const Vector2 normal = SeparationAt(pair, pieces, a.start, b.start).normal;
    if (const auto impact = FindImpact(a, b, end, normal)) {
      first = impact;
      end = impact->time;
    }
  }
  return first;
}

void MoverCollisions::AddTouching(std::vector<BodyPair>& touching) const {
  touching.insert(touching.end(), touching_.begin(), touching_.end());
}

void MoverCollisions::Collect(std::span<const geometry::PlanarPosition> positions,
                              ContactCollector& contacts) const {
  for (const MoverPair& pair : pairs_) {
    const BodyPair bodies{scene_.movers()[pair.first].body, scene_.movers()[pair.second].body};
    for (std::uint32_t i = pair.begin_piece; i < pair.end_piece; ++i) {
      const Interval shared = SharedHeights(
          scene_.footprint(pair.first).pieces[pieces_[i].first], scene_.height(pair.first),
          scene_.footprint(pair.second).pieces[pieces_[i].second], scene_.height(pair.second));
      contacts.Offer(bodies,
                     SeparationAt(pair, pieces_[i], positions[pair.first], positions[pair.second]),
                     (shared.low + shared.high) / 2);
    }
  }
}

}  // namespace gsv::dynamics
