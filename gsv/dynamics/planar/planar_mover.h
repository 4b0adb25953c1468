// Moves wheeled bases on level ground by planar kinematics: with drive limits and contacts, without
// forces.
//
// Bodies      The mover moves bodies that have a drive and are neither static nor rigid, and
//             avatars (an avatar without a drive accepts any velocity). Other bodies keep their
//             poses.
// How         A base follows its command within its drive's limits (DriveKinematics) along an exact
//             arc. Its z, roll and pitch stay as the caller placed it. The mover moves only the
//             joints of wheels and steering. planar_joints.h moves all other joints. Footprints are
//             computed with all joints at zero.
// Ground      Obstacles lower than a robot can climb count as ground: see PlanarScene and
//             ClimbHeight.
// Contact     A base stops about half a micrometre before an obstacle in its way, at any speed and
//             step size. Its linear motion ends, and starts again within the acceleration limits.
//             In the rest of the step it turns on the spot, if its drive can and if there is room.
//             Bases that can move sideways slide along the obstacle. Bases do not push each other.
//             The result does not depend on the order of bodies.
//             A base that starts inside an obstacle can leave it, but cannot move deeper.
// Many steps  StepMany() moves each base by all steps, one base after the other, if no other body
//             is near enough to touch it. Then it moves all other bases step by step.
// Mesh        A mesh is a surface: a robot completely inside a closed mesh touches nothing.
//
// Errors      SetLayout() refuses invalid drives (kBadModel) and poses that are not finite.
// Threads     one thread at a time. With many robots, the work runs on a thread team.
// Determinism Step() is a function of only layout, state and step size. It does not depend on
//             earlier calls or on the size of the team.
#pragma once

#include <memory>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/base/thread_team.h"
#include "gsv/dynamics/motion/engine.h"
#include "gsv/world/snapshot.h"

namespace gsv::dynamics {

// Moves all bases of a layout. See Engine (motion/engine.h) for the functions.
class PlanarMover {
 public:
  virtual ~PlanarMover() = default;
  // As Engine::SetLayout().
  virtual base::Status SetLayout(std::shared_ptr<const world::Layout> layout) = 0;
  // As Engine::Step(), for bodies with planar kinematics.
  virtual void Step(base::SimTime step, world::State& state,
                    std::vector<world::Contact>& contacts) = 0;
  // As Engine::StepMany().
  virtual bool StepMany(base::SimTime step, int count, world::State& state,
                        std::vector<world::Contact>& contacts, MotionFollower& follower) = 0;
  // As Engine::Overlaps().
  virtual std::vector<world::Contact> Overlaps(const world::State& state, double tolerance) = 0;
  // As Engine::OverlapsOf().
  virtual std::vector<world::Contact> OverlapsOf(const world::State& state, int body,
                                                 double tolerance) = 0;
};

// If `team` is null, the calling thread does all work.
std::unique_ptr<PlanarMover> MakePlanarMover(std::shared_ptr<base::ThreadTeam> team = nullptr);

}  // namespace gsv::dynamics
