// The mover of wheeled bases on level ground: kinematics, limits and contacts, no forces.
//
// Who moves   bodies that are neither static nor rigid and have a drive, and avatars (which without
//             a drive take any velocity). All others stand where the state has them.
// How         a base follows its command within its drive's limits (DriveKinematics) along an exact
//             arc; its z, roll and pitch stay as the caller placed it. Joints that are no wheels
//             and no steering are not its own (planar_joints.h), and footprints are those at zero
//             joint positions.
// Ground      what is lower than a robot can climb is ground to it: see PlanarScene and
//             ClimbHeight.
// Contact     a base stops, about half a micrometre away, at what its own motion runs into, at any
//             speed and step size; its linear motion ends, to start again within its acceleration
//             limits. What remains of the step it turns on the spot, where its drive can and there
//             is room; bases that can move sideways slide along. Nobody pushes anybody. The outcome
//             does not depend on the order of bodies.
//             A base that starts inside something may leave it, but get no deeper.
// Mesh        a mesh is its surface: a robot wholly inside a closed one touches nothing.
//
// Errors      SetLayout() refuses drives that make no sense (kBadModel) and poses that are not
//             finite.
// Threads     one thread at a time, which a team helps where there are many robots.
// Determinism Step() is a function of layout, state and step size alone, whatever came before and
//             however large the team is.
#pragma once

#include <memory>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/base/thread_team.h"
#include "gsv/world/snapshot.h"

namespace gsv::dynamics {

// All of it as Engine has it.
class PlanarMover {
 public:
  virtual ~PlanarMover() = default;
  virtual base::Status SetLayout(std::shared_ptr<const world::Layout> layout) = 0;
  virtual void Step(base::SimTime step, world::State& state,
                    std::vector<world::Contact>& contacts) = 0;
  virtual std::vector<world::Contact> Overlaps(const world::State& state, double tolerance) = 0;
  virtual std::vector<world::Contact> OverlapsOf(const world::State& state, int body,
                                                 double tolerance) = 0;
};

// Without a team, the caller works alone.
std::unique_ptr<PlanarMover> MakePlanarMover(std::shared_ptr<base::ThreadTeam> team = nullptr);

}  // namespace gsv::dynamics
