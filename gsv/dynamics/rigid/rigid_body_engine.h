// Rigid-body dynamics: equations of motion in joint coordinates, contacts with Coulomb's friction,
// solved island by island. Bullet finds the contacts of shapes without a closed form.
//
// Accuracy    substeps of at most 1 ms. If a body would move by more than 0.4 of half of its
//             thickness in a substep, the substeps are shorter, down to 1/16 ms. An island is a
//             group of bodies that touch. A heap is a large island of bodies without joints.
//             Islands of few bodies are solved to 1e-9 m/s (IslandSolver), and heaps to 1e-5 m/s
//             (ContactSweeps). Large islands with joints get 1,600 iterations divided by the number
//             of their bodies, but at least 25 and at most 80 (ImpulseRows). Bodies rest 10 µm deep
//             in each other.
// At rest     a body that neither moves nor accelerates by more than 0.1 m/s² keeps its pose
//             bit-identical. While all bodies rest, a step takes almost no time.
//
// Threads     one thread at a time. The work runs on the team, whose size does not change the
//             result.
// Determinism as RigidEngine requires. The impulses of heaps are kept in the state (KeptImpulses).
#pragma once

#include <memory>

#include "gsv/base/thread_team.h"
#include "gsv/dynamics/motion/rigid_engine.h"

namespace gsv::dynamics {

// `team` may be null.
std::unique_ptr<RigidEngine> MakeRigidEngine(std::shared_ptr<base::ThreadTeam> team = nullptr);

}  // namespace gsv::dynamics
