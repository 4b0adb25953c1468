// How far along their motions many bases get before something is in their way.
//
// Method   Begin() lists who may meet whom. Run() first stops each base at the first obstacle, then
//          looks at all pairs of bases at once: whoever's own motion closes a gap is stopped where
//          the pair meets; with the shortened motions the pairs concerned are looked at again,
//          until nothing changes. So the outcome does not depend on the order of bases, and every
//          state in between is free of overlaps: after kRounds rounds those still in conflict stay
//          where they started, which was free.
// Units    metres, seconds, world frame. Spans are as long as PlanarScene::movers().
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gsv/dynamics/pair_finder.h"
#include "gsv/dynamics/planar_scene.h"
#include "gsv/dynamics/time_of_impact.h"
#include "gsv/world/snapshot.h"

namespace gsv::dynamics {

class PlanarSolver {
 public:
  explicit PlanarSolver(const PlanarScene& scene) : scene_(scene) {}

  // Bases are at `starts`, and no part of base m will move further than travels[m] before the next
  // Begin().
  void Begin(std::span<const PlanarPosition> starts, std::span<const double> travels);

  // All move at once from `starts`, base m for times[m] (0: it stands). Where a base is stopped,
  // times[m] becomes when, and normals[m] the direction of what is in its way.
  void Run(std::span<const PlanarPosition> starts, std::span<const Twist> twists,
           std::span<double> times, std::span<Vector2> normals);

  // Who touches whom (within `gap`; below 0: overlaps by more than -gap) with bases at `positions`,
  // by (first, second). `began` says that they did not touch at Begin(). Valid until the next call.
  std::vector<world::Contact> FindContacts(std::span<const PlanarPosition> positions, double gap);

 private:
  static constexpr int kRounds = 8;

  struct NearObstacle {
    std::uint32_t mover, piece, obstacle;
    int level;
  };
  struct PiecePair {
    std::uint32_t first, second;  // pieces of the two footprints
  };
  struct NearPair {
    std::uint32_t first, second;           // movers
    std::uint32_t begin_piece, end_piece;  // its run in near_pieces_
  };
  struct BodyPair {
    int first, second;
    friend auto operator<=>(const BodyPair&, const BodyPair&) = default;
  };
  struct Motions {
    std::span<const PlanarPosition> starts;
    std::span<const Twist> twists;
    std::span<const double> times;
  };

  void FindNearObstacles(std::span<const PlanarPosition> starts, std::span<const double> travels);
  void FindNearPairs(std::span<const PlanarPosition> starts, std::span<const double> travels);
  void StopAtObstacles(const Motions& motions, std::span<double> times, std::span<Vector2> normals);
  void StopAtEachOther(const Motions& motions, std::span<double> times, std::span<Vector2> normals);
  std::optional<Impact> PairImpact(const Motions& motions, const NearPair& pair) const;
  std::optional<Impact> FirstImpact(const NearPair& pair, MovingPiece a, MovingPiece b,
                                    double end) const;
  const Footprint::Piece& PieceOf(std::uint32_t mover, std::uint32_t piece) const {
    return scene_.movers()[mover].footprint->pieces[piece];
  }
  void MarkBegan(std::vector<world::Contact>& contacts) const;

  const PlanarScene& scene_;
  PairFinder pair_finder_;
  std::vector<Vector2> centres_;
  std::vector<double> radii_, next_times_;
  std::vector<std::uint8_t> changed_, next_changed_;
  std::vector<NearObstacle> near_obstacles_;  // by mover, piece
  std::vector<NearPair> near_pairs_;
  std::vector<PiecePair> near_pieces_;
  std::vector<BodyPair> touched_;  // at Begin(), ascending
};

}  // namespace gsv::dynamics
