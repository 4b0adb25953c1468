// Computes how planar robots push rigid bodies in their way: at the robot's target speed, with a
// force of at most its own weight (traction 1).
//
// Threads  one thread at a time.
#pragma once

#include <span>
#include <vector>

#include "gsv/dynamics/motion/drive_kinematics.h"
#include "gsv/dynamics/motion/rigid_engine.h"

namespace gsv::dynamics {

// Computes how planar robots push the rigid bodies that stopped them.
class PlanarPushes {
 public:
  // Rejects invalid drives with kBadModel.
  base::Status SetLayout(std::shared_ptr<const world::Layout> layout);

  // Returns the pushes by planar robots that rigid bodies have stopped (`contacts`) when planar
  // kinematics moved the robots from `before` to `state`. They are ordered by (robot, object).
  std::span<Push> Find(base::SimTime step, const world::State& before, const world::State& state,
                       const std::vector<world::Contact>& contacts);

  // Call this after the rigid bodies have moved. A robot that pushes gets the speed of the pushed
  // body; if it pushes several bodies, the speed of the slowest one.
  void LimitSpeeds(base::SimTime step, const world::State& before, world::State& state) const;
  // Sets the impulses of the contacts through which robots pushed.
  void SetImpulses(std::vector<world::Contact>& contacts) const;

 private:
  // A planar body that can push rigid bodies.
  struct Pusher {
    int body = 0;                // index of the body in the layout
    double low = 0;              // the robot pushes above this height over the model's origin, m
    double mass = 0;             // mass of the robot, kg; limits the force of its pushes
    DriveKinematics kinematics;  // kinematics of the robot's drive
  };

  // Returns the pusher of a planar body, by the body's index in the layout.
  const Pusher& PusherOf(int body) const;

  std::shared_ptr<const world::Layout> layout_;
  std::vector<Pusher> pushers_;  // the planar bodies, in the order of the layout
  std::vector<Push> pushes_;     // the result of the last Find()
};

}  // namespace gsv::dynamics
