// Rigid-body dynamics: equations of motion in joint coordinates, contacts with Coulomb's friction,
// solved island by island. Bullet finds the contacts of shapes without a closed form.
//
// Accuracy    substeps of at most 1 ms, shorter (down to 1/16 ms) where something moves by more
//             than 0.4 of its half thickness in one. Islands (bodies that touch) of few bodies are
//             solved to 1e-9 m/s (IslandSolver), heaps to 1e-5 m/s (ContactSweeps), and large
//             islands with joints by at most 80 iterations (ImpulseRows), or 1,600 over the number
//             of their bodies, but at least 25. Bodies rest 10 µm deep in each other.
// At rest     a body that neither moves nor accelerates by more than 0.1 m/s² keeps its pose
//             bit-identical. While all bodies rest, a step takes almost no time.
//
// Threads     one thread at a time; the team helps. The result does not depend on it.
// Determinism as RigidEngine has it. The impulses of heaps are kept in the state (KeptImpulses).
#pragma once

#include <memory>

#include "gsv/base/thread_team.h"
#include "gsv/dynamics/motion/rigid_engine.h"

namespace gsv::dynamics {

// `team` may be null.
std::unique_ptr<RigidEngine> MakeRigidEngine(std::shared_ptr<base::ThreadTeam> team = nullptr);

}  // namespace gsv::dynamics
