// Follows how the bases of robots move: since when each one moves or not, and for how long it was
// commanded to move without effect. It costs a comparison of poses per robot every 0.1 s of simulated
// time.
//
// A base moves if within the last second it got further than 1 cm or 0.02 rad from where it was. A
// base that vibrates or creeps below this speed does not move.
//
// Threads      one at a time.
// Determinism  a function of the followed snapshots.
#pragma once

#include <memory>
#include <vector>

#include "gsv/simulation/types.h"
#include "gsv/world/snapshot.h"

namespace gsv::simulation {

// Commanded to move for `stuck_after` without moving, and still commanded to.
bool IsStuck(const Motion& motion, SimTime stuck_after);

class MotionHistory {
 public:
  // Samples the first snapshot at or after each multiple of 0.1 s. A snapshot of an earlier time
  // than the last one begins a new history.
  void Follow(const world::Snapshot& snapshot);

  // The motion of a robot, but for its contact partner and `is_stuck`. `body` is its index in
  // `snapshot`, which may be younger than the last sample.
  Motion Of(const world::Snapshot& snapshot, int body) const;

 private:
  struct Track {
    geometry::Pose anchor;  // where it was up to a second ago
    SimTime anchored_at{0};
    SimTime moved_at{0};  // when it was seen to move last
    SimTime moves_since{0};
    SimTime commanded_for{0};
    SimTime contact_since{0};
    bool has_moved = false;
    bool is_in_contact = false;
  };

  void FollowLayout(const world::Snapshot& snapshot);
  static Track Begin(const world::Snapshot& snapshot, std::size_t body);

  std::shared_ptr<const world::Layout> layout_;
  std::vector<Track> tracks_;  // as the bodies of layout_
  SimTime sampled_{0};
};

// For each body the first one that it touches, besides those that carry it; -1: none.
std::vector<int> ContactPartners(const world::Snapshot& snapshot);

}  // namespace gsv::simulation
