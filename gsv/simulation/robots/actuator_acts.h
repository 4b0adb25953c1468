// What a robot's behaviour tells its actuators, until the next step takes it.
//
// Determinism  of what one actuator is told in a step the last holds, in the robot's own order;
//              different robots' actuators have nothing to do with each other.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gsv/simulation/robots/mounted_sensor.h"
#include "gsv/world/state.h"

namespace gsv::simulation {

struct ActuatorAct {
  std::string actuator;
  world::ActuatorSetupPtr setup;
  std::optional<world::ActuatorOrder> order;  // empty: it has been taken off
};
using ActuatorActs = std::vector<ActuatorAct>;  // one of an actuator at most

// Refuses what is no actuator, and what it cannot do.
base::Result<ActuatorAct> MakeAct(const MountedSensor& actuator, world::ActuatorOrder order,
                                  const std::string& robot);

// Adds `act`, in place of an earlier one of that actuator.
void Add(ActuatorAct act, ActuatorActs& acts);

// Has the acts of robots, in any order, act from `state`'s instant on.
void Obey(std::vector<std::pair<std::string, ActuatorActs>> acts, world::State& state);

}  // namespace gsv::simulation
