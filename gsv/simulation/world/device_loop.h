// Takes the devices of robots through a step, whatever their types are.
//
// Determinism  a function of the snapshot, the state and the actions; the order in which robots
//              come in `actions` leaves no trace.
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

// By robot, each once.
using DeviceActions = std::vector<std::pair<std::string, std::vector<DeviceAction>>>;

// Before the bodies move: applies `actions`, by robots' names, and then has each device do its part
// of the step of `length` from `now` on. `state` is that of `now`. Gives what radios sent.
std::vector<world::Transmission> StepDevices(const std::shared_ptr<const world::Snapshot>& now,
                                             base::SimTime length, DeviceActions actions,
                                             sensing::RaySceneCache& rays, base::ThreadTeam* team,
                                             world::State& state);

// After the bodies have moved, to where they are at `time`.
void MoveDevices(const world::Layout& layout, base::SimTime time, world::State& state);

// After the bodies of `layout` have become others, or were placed elsewhere (`placed`): a device
// goes with its robot.
void CarryOverDevices(const world::Layout& layout, const std::vector<std::string>& placed,
                      world::State& state);

}  // namespace gsv::simulation
