// Adds a scenario's robots and avatars to a simulation and sets their behaviours, for `gsv run` and
// for simulations created in the viewer.
//
// Errors  an error names the part of the scenario, such as "robots[1].model".
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

// The placement of robots for which no place is given.
struct Placing {
  enum class Kind { kSpiral, kGrid, kRandom };
  Kind kind = Kind::kSpiral;
  int count = 0;           // the number of all robots that are placed in this way
  std::uint64_t seed = 0;  // seed of kRandom
};

// A robot of the scenario that was added to the simulation.
struct PlacedRobot {
  scenario::RobotEntry entry;  // with its actual name, and with its place if it has a model
  std::size_t index = 0;       // the index in the scenario's list
};

// The robots and avatars that were added.
struct Population {
  std::vector<PlacedRobot> robots, avatars;  // each list is in the order in which they were added
};

// Adds the robots and the avatars, without behaviours. A robot without a model must exist in the
// world. A robot without a place gets a free one. By default, this is the first free place on a
// spiral about the origin. `placing` can instead select the cells of a grid of 1 m, from the origin
// outwards, or random places in a disc whose size grows with the number of robots. Adds the
// problems of model files to `problems`.
FieldResult<Population> Populate(simulation::Simulation& simulation, formats::ModelLibrary& library,
                                 const scenario::Scenario& scenario, base::Problems& problems,
                                 const Placing& placing = {});

// Makes a robot's behaviour. Returns null if the robot has none.
using BehaviourMaker = std::function<FieldResult<std::shared_ptr<simulation::BehaviourPort>>(
    const scenario::RobotEntry&)>;

// Makes the behaviours of the robots, and sets them in the simulation.
FieldResult<void> GiveBehaviours(simulation::Simulation& simulation,
                                 const std::vector<PlacedRobot>& robots,
                                 const BehaviourMaker& make);

// Returns the model that a robot has in the simulation's world file, even if the robot was removed.
// Returns null if the world has no model with that name.
std::shared_ptr<const model::Model> ModelInWorld(const simulation::Simulation& simulation,
                                                 const std::string& name);

// Adds one robot or avatar, with its behaviour. If the entry has no model, the model of that name
// in the world is used. Returns the actual name of the robot or avatar.
FieldResult<std::string> AddOne(simulation::Simulation& simulation, formats::ModelLibrary& library,
                                const scenario::RobotEntry& robot, bool is_avatar,
                                const BehaviourMaker& make, base::Problems& problems);

// Adds an object that is not a robot. An object without a place gets the first free place, like a
// robot. Returns the object's actual name.
FieldResult<std::string> AddOneObject(simulation::Simulation& simulation,
                                      formats::ModelLibrary& library,
                                      const gateway::ObjectRequest& object,
                                      base::Problems& problems);

}  // namespace gsv::app
