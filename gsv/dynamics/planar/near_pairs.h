// Which movers may run into each other, and when they do.
//
// Method       Candidates, the pairs that come close within some steps, are searched for only when
//              a mover has left the room that it was given for that (a Verlet list). Find() picks
//              from them those that may meet now. Stop() looks at all of these at once: whoever's
//              own motion closes a gap is stopped where the pair meets; with the shortened motions
//              the pairs concerned are looked at again, until nothing changes. So the outcome does
//              not depend on the order of movers, and every state in between is free of overlaps:
//              after kRounds rounds those still in conflict stay where they started, which was
//              free. Nor does it depend on when candidates were searched for: Find() judges.
// Units        metres, seconds, world frame. Spans are as long as PlanarScene::movers().
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "gsv/base/thread_team.h"
#include "gsv/dynamics/planar/pair_finder.h"
#include "gsv/dynamics/planar/planar_scene.h"
#include "gsv/dynamics/shapes/contact_collector.h"
#include "gsv/dynamics/shapes/time_of_impact.h"

namespace gsv::dynamics {

class NearPairs {
 public:
  NearPairs(const PlanarScene& scene, base::ThreadTeam& team) : scene_(scene), team_(team) {}

  // Forgets all; to be called when the scene has been sliced anew.
  void Reset();

  // Whether the candidates hold for the mover: no part of it leaves its room if it moves no further
  // than `travel` from `at`. Threads: may run concurrently.
  bool HasRoom(std::uint32_t mover, const geometry::PlanarPosition& at, double travel) const {
    const Room& room = rooms_[mover];
    const double left = room.radius - travel;
    const Vector2 moved = Vector2{at.x, at.y} - room.centre;
    return left > 0 && Dot(moved, moved) < left * left;
  }
  void FindCandidates(std::span<const geometry::PlanarPosition> starts,
                      std::span<const double> travels);

  // Lists the pairs that may meet while no part of mover m moves further than travels[m]. All
  // movers have room.
  void Find(std::span<const geometry::PlanarPosition> starts, std::span<const double> travels);
  // Lists those of one mover with `others`, in ascending order, as they stand. Nobody needs room.
  void FindOf(std::uint32_t mover, std::span<const std::uint32_t> others,
              std::span<const geometry::PlanarPosition> starts);

  // Stops movers, which start at starts[m] and move for times[m], where they meet: times[m] becomes
  // when, normals[m] the direction of who is in the way.
  void Stop(std::span<const geometry::PlanarPosition> starts,
            std::span<const geometry::Twist> twists, std::span<double> times,
            std::span<Vector2> normals);

  // Appends to `touching` who touched whom when found.
  void AddTouching(std::vector<BodyPair>& touching) const;
  // Offers the contacts of movers at `positions`.
  void Collect(std::span<const geometry::PlanarPosition> positions,
               ContactCollector& contacts) const;

 private:
  static constexpr int kRounds = 8;

  struct PiecePair {
    std::uint32_t first, second;  // pieces of the two footprints
    geometry::PlanarPosition first_found_at, second_found_at;
    Separation separation;  // there
  };
  struct NearPair {
    std::uint32_t first, second;           // movers
    std::uint32_t begin_piece, end_piece;  // its run in near_pieces_
  };
  struct Room {
    Vector2 centre;
    double radius = -1;
  };
  // Of a mover, while it is looked for.
  struct Outcome {
    double time;           // how far it gets
    int since, new_since;  // the round that found this, as seen by this round and by the next
  };
  struct Motions {
    std::span<const geometry::PlanarPosition> starts;
    std::span<const geometry::Twist> twists;
    std::span<const double> times;
  };

  void Clear();
  void AddIfNear(std::uint32_t first, std::uint32_t second,
                 std::span<const geometry::PlanarPosition> starts, double within);
  Separation SeparationAt(const NearPair& pair, const PiecePair& pieces,
                          const geometry::PlanarPosition& first_at,
                          const geometry::PlanarPosition& second_at) const;
  void FindImpacts(const Motions& motions, int round);
  std::optional<Impact> PairImpact(const Motions& motions, const NearPair& pair) const;
  std::optional<Impact> FirstImpact(const NearPair& pair, MovingPiece a, MovingPiece b,
                                    double end) const;

  const PlanarScene& scene_;
  base::ThreadTeam& team_;
  std::vector<Room> rooms_;
  PairFinder finder_;
  std::vector<Vector2> centres_;
  std::vector<double> radii_;
  std::vector<PairFinder::Pair> candidates_;

  std::vector<NearPair> pairs_;
  std::vector<PiecePair> pieces_;
  std::vector<BodyPair> touching_;

  std::vector<Outcome> outcomes_;               // of the movers in pairs_
  std::vector<std::optional<Impact>> impacts_;  // of pairs_, in this round
};

}  // namespace gsv::dynamics
