// The worlds of `gsv bench rigid`: bodies under rigid-body dynamics, on a plane or a mesh.
// bench/rigid compares the rovers and the boxes with the same scenes in other engines.
#pragma once

#include <memory>
#include <string>

#include "gsv/model/world_description.h"

namespace gsv::app {

enum class RigidScenario {
  kRovers,   // boxes of 20 kg on four motorised wheels, 2 m apart on a plane
  kBoxes,    // boxes of 0.3 m and 1 kg, dropped into a heap
  kTerrain,  // the rovers on a mesh with waves of 0.15 m
  kArms,     // arms of six joints, which move to a pose and hold it
};

// The name of the first body.
inline constexpr const char* kFirstRigidBody = "body_00000";

// Returns the world, with a step of 1 ms.
std::shared_ptr<const model::WorldDescription> RigidWorldOf(RigidScenario scenario, int bodies);

}  // namespace gsv::app
