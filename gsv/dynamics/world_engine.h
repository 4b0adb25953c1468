// The engine of a whole world. Planar kinematics moves wheeled bases and people. An engine of
// rigid-body dynamics moves bodies that fall, tip over or have joints driven by forces.
//
// Together    Rigid bodies stop planar bodies. Planar bodies push rigid bodies at their own target
//             speed, with a force of at most their own weight (traction 1). A rigid body that hits
//             a planar robot bounces off and does not move the robot. A body that lies on a robot
//             moves with it.
// Cost        A world without rigid bodies costs as much as the planar mover alone.
// Determinism as for Engine.
#pragma once

#include <memory>

#include "gsv/base/thread_team.h"
#include "gsv/dynamics/motion/engine.h"
#include "gsv/dynamics/motion/rigid_engine.h"

namespace gsv::dynamics {

// The engine's work runs on `team`; if it is null, on the calling thread. `rigid` moves the rigid
// bodies (default: the solver of rigid/).
std::unique_ptr<Engine> MakeWorldEngine(std::shared_ptr<base::ThreadTeam> team = nullptr,
                                        std::unique_ptr<RigidEngine> rigid = nullptr);

}  // namespace gsv::dynamics
