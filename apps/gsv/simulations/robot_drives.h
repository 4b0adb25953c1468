// Finds the drives of robots whose files define none.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/model/world_description.h"
#include "gsv/scenario/scenario.h"
#include "gsv/simulation/simulation.h"

namespace gsv::app {

// Returns the world with drives for the models that the scenario lists as robots. If the scenario's
// entry has a drive, the model gets this drive. If neither the entry nor the model has a drive, the
// drive is guessed from the model. Returns the same world if nothing changes.
base::Result<std::shared_ptr<const model::WorldDescription>> WithDrives(
    std::shared_ptr<const model::WorldDescription> world, const scenario::Scenario& scenario);

// Parses values of --drive, which have the form ROBOT=KIND[,KEY=VALUE]…. Returns a map from ROBOT
// to the text after "=". Returns kInvalidArgument, with the wrong option, if a value cannot be
// parsed.
base::Result<std::map<std::string, std::string>> ParseDrives(const std::vector<std::string>& texts);

// Returns a line "NAME: drive: …" for robots whose model file defines no drive. Robots with the
// same model share one line, with the name of the first robot.
std::vector<std::string> DriveNotes(const simulation::Simulation& simulation);

}  // namespace gsv::app
