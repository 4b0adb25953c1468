// The lamps of robots that are on.
#pragma once

#include <vector>

#include "gsv/model/world_description.h"
#include "gsv/world/snapshot.h"

namespace gsv::rendering {

struct LitLamp {
  int body = 0;
  const world::DeviceMount* mount = nullptr;  // the snapshot's
  world::Glow glow;
};

// By robot, then lamp.
std::vector<LitLamp> LitLamps(const world::Snapshot& snapshot);

// The light of a lamp.
model::Light LightOf(const LitLamp& lit, const world::Snapshot& snapshot);

}  // namespace gsv::rendering
