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
  // The current state. Poses are the poses of `now`. Devices that come before this device (by robot
  // and name) have already done this step.
  const State& state;
  // Messages that were sent in this step, ordered by sender.
  std::vector<Transmission>& transmissions;
  std::uint64_t seed = 0;  // seed of the simulation
};

}  // namespace gsv::world
