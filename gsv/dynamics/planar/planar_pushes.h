// How planar robots push the rigid bodies in their way: at the speed that they want, with a force
// of at most their own weight (traction 1).
//
// Threads  one thread at a time.
#pragma once

#include <span>
#include <vector>

#include "gsv/dynamics/motion/drive_kinematics.h"
#include "gsv/dynamics/motion/rigid_engine.h"

namespace gsv::dynamics {

class PlanarPushes {
 public:
  // Refuses drives that make no sense (kBadModel).
  base::Status SetLayout(std::shared_ptr<const world::Layout> layout);

  // The pushes of the planar robots that `contacts` stopped at rigid bodies, in the order of
  // (robot, object), after planar kinematics took them from `before` to `state`.
  std::span<Push> Find(base::SimTime step, const world::State& before, const world::State& state,
                       const std::vector<world::Contact>& contacts);

  // Call this after the rigid bodies were moved. A robot that pushes continues as fast as the
  // pushed body. The slowest of several pushed bodies limits its speed.
  void LimitSpeeds(base::SimTime step, const world::State& before, world::State& state) const;
  // Sets the impulses of the contacts through which robots pushed.
  void SetImpulses(std::vector<world::Contact>& contacts) const;

 private:
  struct Pusher {
    int body = 0;    // index in the layout
    double low = 0;  // height (m) above the model's origin from which on it pushes
    double mass = 0;
    DriveKinematics kinematics;
  };

  const Pusher& PusherOf(int body) const;

  std::shared_ptr<const world::Layout> layout_;
  std::vector<Pusher> pushers_;  // the planar bodies, in the order of the layout
  std::vector<Push> pushes_;
};

}  // namespace gsv::dynamics
