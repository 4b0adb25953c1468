// Finds the lamps of robots that are on.
#pragma once

#include <vector>

#include "gsv/model/world_description.h"
#include "gsv/world/snapshot.h"

namespace gsv::rendering {

// A lamp that is on.
struct LitLamp {
  int body = 0;                               // index of the robot in the layout
  const world::DeviceMount* mount = nullptr;  // refers to the snapshot
  world::Glow glow;                           // its light
};

// Returns the lamps that are on, ordered by robot and then by lamp.
std::vector<LitLamp> LitLamps(const world::Snapshot& snapshot);

// Returns the light that a lamp emits.
model::Light LightOf(const LitLamp& lit, const world::Snapshot& snapshot);

}  // namespace gsv::rendering
