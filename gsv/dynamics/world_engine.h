// The engine of a whole world: planar kinematics for wheeled bases and people, an engine of
// rigid-body dynamics for all that falls, tips or has joints that forces move.
//
// Together    rigid bodies stop planar ones, which push them: with the speed that they want, and a
//             force of at most their own weight (traction 1). A planar robot gives way to nothing:
//             what runs into it bounces off. What lies on a robot rides along.
// Cost        a world without rigid bodies costs what the planar mover costs.
// Determinism as Engine has it, for both.
#pragma once

#include <memory>

#include "gsv/base/thread_team.h"
#include "gsv/dynamics/motion/engine.h"
#include "gsv/dynamics/motion/rigid_engine.h"

namespace gsv::dynamics {

// The team helps the planar mover; without one, the caller works alone. `rigid` moves the rigid
// bodies (default: Bullet).
std::unique_ptr<Engine> MakeWorldEngine(std::shared_ptr<base::ThreadTeam> team = nullptr,
                                        std::unique_ptr<RigidEngine> rigid = nullptr);

}  // namespace gsv::dynamics
