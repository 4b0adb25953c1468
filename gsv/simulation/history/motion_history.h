// Tracks the motion of robots' bases: since when each base has been moving or at rest, and for how
// long it has been commanded to move without effect. For this, the poses of each robot are compared
// every 0.1 s of simulated time.
//
// A base counts as moving if within the last second its distance from an earlier pose exceeded 1 cm
// or 0.02 rad. So a base that vibrates or creeps does not count as moving.
//
// Threads      one at a time.
// Determinism  a function of the followed snapshots.
#pragma once

#include <memory>
#include <vector>

#include "gsv/simulation/types.h"
#include "gsv/world/snapshot.h"

namespace gsv::simulation {

// Whether the base is at rest and commanded to move, and has been commanded to move for at least
// `stuck_after` in total since its last motion.
bool IsStuck(const Motion& motion, SimTime stuck_after);

// Records since when each robot has been moving, at rest or stuck.
class MotionHistory {
 public:
  // Samples the first snapshot at or after each multiple of 0.1 s, and the first one of each
  // layout. A snapshot of an earlier time than the last sample begins a new history.
  void Follow(const world::Snapshot& snapshot);
  // Returns the first instant after `now` that is sampled.
  static SimTime NextSampling(SimTime now);

  // Returns the motion of a robot, but does not set Motion::contact and Motion::is_stuck. `body` is
  // the robot's index in `snapshot`, which may be newer than the last sample.
  Motion Of(const world::Snapshot& snapshot, int body) const;

 private:
  // The motion of one body so far.
  struct Track {
    geometry::Pose anchor;     // pose at some time within the last second
    SimTime anchored_at{0};    // time of `anchor`
    SimTime moved_at{0};       // the last time at which the base moved
    SimTime moves_since{0};    // start of the present motion
    SimTime commanded_for{0};  // see Motion::commanded_for
    SimTime contact_since{0};  // start of the present contact
    bool has_moved = false;
    bool is_in_contact = false;
  };

  // Keeps the tracks of bodies that are also in the new layout, by name.
  void FollowLayout(const world::Snapshot& snapshot);
  // Returns the track of a body that is at rest from now on.
  static Track Begin(const world::Snapshot& snapshot, std::size_t body);

  std::shared_ptr<const world::Layout> layout_;
  std::vector<Track> tracks_;  // one for each body of layout_
  SimTime sampled_{0};         // time of the last sample
};

// Returns, for each body, the first other body that it touches, or -1. Contacts with a body that
// supports the other body are ignored.
std::vector<int> ContactPartners(const world::Snapshot& snapshot);

}  // namespace gsv::simulation
