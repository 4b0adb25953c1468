// Finds which movers collide with each other, and when. A mover is a body that planar kinematics
// moves.
//
// Method       Candidates are pairs that may come close within some steps. The search for
//              candidates is repeated only when a mover leaves the space that the last search
//              covered (a Verlet list). Find() selects the candidates that may touch in this step.
//              Stop() checks all of these pairs. A mover whose own motion closes a gap is stopped
//              where the pair touches. The affected pairs are then checked again with the shortened
//              motions, until nothing changes. So the result does not depend on the order of the
//              movers. After kIterations iterations, movers that still collide stay at their
//              starts, where they do not overlap. The result does not depend on when the candidates
//              were searched for.
// Units        metres, seconds, world frame. Spans are as long as PlanarScene::movers().
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "gsv/base/thread_team.h"
#include "gsv/dynamics/planar/broad_phase.h"
#include "gsv/dynamics/planar/planar_scene.h"
#include "gsv/dynamics/shapes/contact_collector.h"
#include "gsv/dynamics/shapes/time_of_impact.h"

namespace gsv::dynamics {

// Finds collisions between movers, and stops the movers at these collisions.
class MoverCollisions {
 public:
  MoverCollisions(const PlanarScene& scene, base::ThreadTeam& team) : scene_(scene), team_(team) {}

  // Removes all pairs. Must be called after each PlanarScene::Slice().
  void Reset();

  // Whether the candidates are still valid for a mover that moves no further than `travel` from
  // `at`. They are valid if no part of the mover leaves the space that was searched. Threads: may
  // run concurrently.
  bool HasRoom(std::uint32_t mover, const geometry::PlanarPosition& at, double travel) const {
    const Room& room = rooms_[mover];
    const double left = room.radius - travel;
    const Vector2 moved = Vector2{at.x, at.y} - room.centre;
    return left > 0 && Dot(moved, moved) < left * left;
  }
  // Searches for the candidates of all movers again, if mover m moves by up to travels[m].
  void FindCandidates(std::span<const geometry::PlanarPosition> starts,
                      std::span<const double> travels);

  // Lists the pairs that may touch if no part of mover m moves further than travels[m]. HasRoom()
  // must be true for all movers.
  void Find(std::span<const geometry::PlanarPosition> starts, std::span<const double> travels);
  // Sets is_near[m] of both movers of each pair that may touch if no part of mover m moves further
  // than travels[m]. HasRoom() must be true for all movers. FindMarked() lists such pairs only.
  void MarkNear(std::span<const geometry::PlanarPosition> starts, std::span<const double> travels,
                std::span<std::uint8_t> is_near);
  // As Find(), but only for the pairs that the last MarkNear() has found.
  void FindMarked(std::span<const geometry::PlanarPosition> starts,
                  std::span<const double> travels);
  // Lists the pairs of `mover` and one of `others` that touch with all movers at `starts`. `others`
  // must be in ascending order. HasRoom() need not be true.
  void FindOf(std::uint32_t mover, std::span<const std::uint32_t> others,
              std::span<const geometry::PlanarPosition> starts);

  // Stops movers where they touch each other. Mover m starts at starts[m] and moves for times[m].
  // If it is stopped, times[m] becomes the time of the contact, and normals[m] the direction
  // towards the other mover.
  void Stop(std::span<const geometry::PlanarPosition> starts,
            std::span<const geometry::Twist> twists, std::span<double> times,
            std::span<Vector2> normals) {
    StopIn(&team_, starts, twists, times, normals);
  }
  // As Stop(), but the calling thread does all work, so the team may work on something else.
  void StopAlone(std::span<const geometry::PlanarPosition> starts,
                 std::span<const geometry::Twist> twists, std::span<double> times,
                 std::span<Vector2> normals) {
    StopIn(nullptr, starts, twists, times, normals);
  }

  // Appends to `touching` the listed pairs that touched at the `starts` of the last Find(),
  // FindMarked() or FindOf().
  void AddTouching(std::vector<BodyPair>& touching) const;
  // Passes the contacts of movers at `positions` to the collector.
  void Collect(std::span<const geometry::PlanarPosition> positions,
               ContactCollector& contacts) const;

 private:
  static constexpr int kIterations = 8;  // see "Method" above

  // Two pieces of a MoverPair that may touch.
  struct PiecePair {
    std::uint32_t first, second;  // indices of pieces of the two footprints
    geometry::PlanarPosition first_found_at, second_found_at;  // positions of the two movers
    Separation separation;  // separation of the two pieces at first_found_at and second_found_at
  };
  // Two movers that may touch in this step.
  struct MoverPair {
    std::uint32_t first, second;           // movers
    std::uint32_t begin_piece, end_piece;  // range of the pair's entries in pieces_
  };
  // A circle around a mover. While the origin of each mover stays in its circle, the candidates
  // contain all pairs that may touch. FindCandidates() sets the circles of all movers. They are
  // valid until its next call or Reset(). See HasRoom().
  struct Room {
    Vector2 centre;      // the mover's origin at the search
    double radius = -1;  // m; negative before the first search
  };
  // The result for a mover so far.
  struct Outcome {
    double time;           // time until the mover stops, s
    int since, new_since;  // first iteration with this `time`; `since` for the next iteration
  };
  // The motions of all movers, as passed to Stop(): positions at the start, constant twists in each
  // mover's frame, and durations in s.
  struct Motions {
    std::span<const geometry::PlanarPosition> starts;
    std::span<const geometry::Twist> twists;
    std::span<const double> times;
  };

  // Removes the pairs of the last step.
  void Clear();
  // Lists those of `pairs` that may touch.
  void FindAmong(std::span<const BroadPhase::Pair> pairs,
                 std::span<const geometry::PlanarPosition> starts, std::span<const double> travels);
  // Whether the footprints' bounding circles are closer than `within`.
  bool AreNear(std::uint32_t first, std::uint32_t second,
               std::span<const geometry::PlanarPosition> starts, double within) const;
  // Adds the pair if two of its pieces are closer than `within`.
  void AddIfNear(std::uint32_t first, std::uint32_t second,
                 std::span<const geometry::PlanarPosition> starts, double within);
  // Returns the separation of two pieces of a pair with the movers at these positions.
  Separation SeparationAt(const MoverPair& pair, const PiecePair& pieces,
                          const geometry::PlanarPosition& first_at,
                          const geometry::PlanarPosition& second_at) const;
  // Stop() on the threads of a team; on the calling thread if `team` is null.
  void StopIn(base::ThreadTeam* team, std::span<const geometry::PlanarPosition> starts,
              std::span<const geometry::Twist> twists, std::span<double> times,
              std::span<Vector2> normals);
  // Computes impacts_ for the pairs with a mover whose stop time has changed in this iteration.
  void FindImpacts(base::ThreadTeam* team, const Motions& motions, int round);
  // Returns the first impact of two movers, also after one of them has stopped.
  std::optional<Impact> PairImpact(const Motions& motions, const MoverPair& pair) const;
  // Returns the first impact of any two pieces of the pair before `end`.
  std::optional<Impact> FirstImpact(const MoverPair& pair, MovingPiece a, MovingPiece b,
                                    double end) const;

  const PlanarScene& scene_;
  base::ThreadTeam& team_;
  std::vector<Room> rooms_;                   // one for each mover, from the last FindCandidates()
  BroadPhase finder_;                         // finds candidates_
  std::vector<Vector2> centres_;              // discs of the movers for finder_
  std::vector<double> radii_;                 // radii of these discs, m
  std::vector<BroadPhase::Pair> candidates_;  // pairs that may come close within some steps
  std::vector<BroadPhase::Pair> marked_;      // pairs that the last MarkNear() has found

  std::vector<MoverPair> pairs_;    // pairs that may touch in this step
  std::vector<PiecePair> pieces_;   // pieces of pairs_, pair by pair
  std::vector<BodyPair> touching_;  // see AddTouching()

  std::vector<Outcome> outcomes_;               // outcomes of the movers in pairs_
  std::vector<std::optional<Impact>> impacts_;  // impacts of pairs_ in this iteration
};

}  // namespace gsv::dynamics
