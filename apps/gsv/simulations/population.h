// Puts a scenario's robots and avatars into a simulation and gives them their behaviours: for
// `gsv run` as for what people create in the viewer.
//
// Errors  name the part of the scenario that they concern, as in "robots[1].model".
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "gsv/formats/sdf_reader.h"
#include "gsv/gateway/program/simulation_factory.h"
#include "gsv/scenario/scenario.h"
#include "gsv/simulation/simulation.h"

namespace gsv::app {

using gateway::FieldError;
using gateway::FieldResult;

struct PlacedRobot {
  scenario::RobotEntry entry;  // as it stands: with its name, and its place if it has a model
  std::size_t index = 0;       // in the scenario's list
};

struct Population {
  std::vector<PlacedRobot> robots, avatars;  // in the order in which they were added
};

// Adds the robots and the avatars, without behaviours; a robot without a model must be there
// already, with the world. One without a place gets the first free one on a spiral about the
// origin. What the files lack is added to `problems`.
FieldResult<Population> Populate(simulation::Simulation& simulation, formats::ModelLibrary& library,
                                 const scenario::Scenario& scenario, base::Problems& problems);

// Makes a robot's behaviour; null where it is to have none.
using BehaviourMaker = std::function<FieldResult<std::shared_ptr<simulation::BehaviourPort>>(
    const scenario::RobotEntry&)>;

tl::expected<void, FieldError> GiveBehaviours(simulation::Simulation& simulation,
                                              const std::vector<PlacedRobot>& robots,
                                              const BehaviourMaker& make);

// Of a robot that comes with the simulation's world, whether it stands there or not; null: the
// world brings no model of that name.
std::shared_ptr<const model::Model> ModelInWorld(const simulation::Simulation& simulation,
                                                 const std::string& name);

// One robot or avatar more, with its behaviour; without a model the one of that name which came
// with the world. Gives the name under which it stands.
FieldResult<std::string> AddOne(simulation::Simulation& simulation, formats::ModelLibrary& library,
                                const scenario::RobotEntry& robot, bool is_avatar,
                                const BehaviourMaker& make, base::Problems& problems);

// A thing that is no robot; without a place at the first one that is free, as a robot. Gives the
// name under which it stands.
FieldResult<std::string> AddOneObject(simulation::Simulation& simulation,
                                      formats::ModelLibrary& library,
                                      const gateway::ObjectRequest& object,
                                      base::Problems& problems);

}  // namespace gsv::app
