// Steps the devices of all robots: actuators, radios and other sensors that keep a state.
//
// Determinism  the result is a function of the snapshot, the state and the actions. It does not
//              depend on the order of robots in `actions`.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "gsv/base/thread_team.h"
#include "gsv/sensing/rays/ray_scene.h"
#include "gsv/simulation/robots/robot_commands.h"
#include "gsv/world/snapshot.h"

namespace gsv::simulation {

// Actions by robot. Each robot occurs once.
using DeviceActions = std::vector<std::pair<std::string, std::vector<DeviceAction>>>;

// Call this before the bodies move. Applies `actions` in the order of robots' names, then calls
// BeforeStep() of each device for the step of `length` that begins at `now`. `state` is the state
// at `now`. Returns the transmissions of radios.
std::vector<world::Transmission> StepDevices(const std::shared_ptr<const world::Snapshot>& now,
                                             base::SimTime length, DeviceActions actions,
                                             sensing::RaySceneCache& rays, base::ThreadTeam* team,
                                             std::uint64_t seed, world::State& state);

// Call this after the bodies have moved to their poses at `time`. Calls AfterMove() of each device.
void MoveDevices(const world::Layout& layout, base::SimTime time, world::State& state);

// Call this after bodies of `layout` were added, removed or moved. `placed` names the moved bodies.
// Calls CarryOver() of each device, and removes devices of removed robots.
void CarryOverDevices(const world::Layout& layout, const std::vector<std::string>& placed,
                      world::State& state);

}  // namespace gsv::simulation
