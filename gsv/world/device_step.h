// What devices are given before a step, and what they may change with it.
#pragma once

#include <memory>
#include <vector>

#include "gsv/world/ray_caster.h"
#include "gsv/world/snapshot.h"

namespace gsv::world {

struct DeviceStep {
  std::shared_ptr<const Snapshot> now;  // the world that is about to move
  base::SimTime length{0};              // of the step
  const RayCaster& rays;                // against the collision surfaces of `now`
  // Bodies as in `now`; devices as those before this one, by robot and name, have left them.
  const State& state;
  std::vector<Transmission>& transmissions;  // sent in this step, in the order of senders
};

}  // namespace gsv::world
