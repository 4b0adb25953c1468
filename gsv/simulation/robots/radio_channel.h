// Carries messages between the radios of a simulation's robots, at the boundary between two steps.
//
// Determinism  what is heard, and in which order, depends on who sent what since the last step and
//              where the robots stand, and not on the order in which they said so.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "gsv/base/thread_team.h"
#include "gsv/sensing/rays/ray_scene.h"
#include "gsv/simulation/robots/mounted_sensor.h"
#include "gsv/world/snapshot.h"

namespace gsv::simulation {

struct RadioSwitch {
  std::string sensor;
  world::RadioSetupPtr setup;  // null: off
};

struct RadioSending {
  std::string sensor;
  world::RadioSetupPtr setup;  // of the sensor
  std::string receiver;        // robot; empty: all
  std::string content;
};

// What one robot has done with its radios since the last step, in its order.
struct RadioActs {
  std::vector<RadioSwitch> switches;
  std::vector<RadioSending> sendings;

  bool empty() const { return switches.empty() && sendings.empty(); }
};

// Refuses what is no radio, a message that is too long, and more than 64 in one step.
base::Result<RadioSending> MakeSending(const MountedSensor& sensor, const std::string& receiver,
                                       std::string content, const RadioActs& before,
                                       const std::string& robot);

// Switches radios on and off, then has those that are on hear what is sent. `now`: the world as it
// stands in `state`. `acts`: by robot, in any order. Gives what went over the air.
std::vector<world::Transmission> Communicate(const std::shared_ptr<const world::Snapshot>& now,
                                             std::vector<std::pair<std::string, RadioActs>> acts,
                                             sensing::RaySceneCache& rays, base::ThreadTeam* team,
                                             world::State& state);

}  // namespace gsv::simulation
