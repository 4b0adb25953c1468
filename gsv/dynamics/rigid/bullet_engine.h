// Rigid-body dynamics by Bullet, in double precision.
//
// Accuracy    substeps of at most 1 ms, shorter (down to 1/16 ms) where something moves by more
//             than 0.4 of its half thickness in one. Contacts, friction and joints of each island
//             (bodies that touch or are jointed) are solved apart from all others (ImpulseRows),
//             until no velocity changes by more than 1e-7 m/s in an iteration, in 80 iterations at
//             most. Islands of more than 20 rigid bodies get fewer: 1,600 over their number, but at
//             least 25. Bodies rest 10 µm deep in each other.
// At rest     a body that neither moves nor accelerates by more than 0.1 m/s² keeps its pose
//             bit-identical. While all bodies rest, a step takes almost no time.
// Memory      8 MiB once there are rigid bodies.
//
// Threads     one thread at a time; the team helps to solve islands. The result does not depend on
//             it.
// Determinism as RigidEngine has it, with nothing kept from step to step: Bullet's world is built
//             anew for each. See docs/adr/012-bullet-world-of-one-step.md.
#pragma once

#include <memory>

#include "gsv/base/thread_team.h"
#include "gsv/dynamics/motion/rigid_engine.h"

namespace gsv::dynamics {

// `team` may be null.
std::unique_ptr<RigidEngine> MakeBulletEngine(std::shared_ptr<base::ThreadTeam> team = nullptr);

}  // namespace gsv::dynamics
