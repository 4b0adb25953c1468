// The arguments of DeviceState::BeforeStep(), and the state that devices may change.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "gsv/world/ray_caster.h"
#include "gsv/world/snapshot.h"

namespace gsv::world {

struct DeviceStep {
  std::shared_ptr<const Snapshot> now;  // the world before the step
  base::SimTime length{0};              // length of the step
  const RayCaster& rays;                // casts rays at the collision surfaces of `now`
  // The bodies are those of `now`. Devices before this one, by robot and name, were stepped.
  const State& state;
  std::vector<Transmission>& transmissions;  // sent in this step, in the order of senders
  std::uint64_t seed = 0;                    // seed of the simulation
};

}  // namespace gsv::world
