// What requests carry of scenarios: those keys of docs/formats/scenario.md that a person sets in
// the viewer. A server takes no paths to write to, folders or plug-ins from its viewers.
//
// Errors  kInvalidArgument with the field; unknown keys are refused, since a misspelt one would be
//         left out silently.
// Bounded so many robots as no person types.
#pragma once

#include <string_view>

#include "gsv/gateway/program/simulation_factory.h"

namespace gsv::gateway {

// {name, world, mode: real_time|lockstep, factor, step, duration, seed, record, robots, avatars};
// `record` is true or false here. Only the world is needed.
FieldResult<SimulationRequest> ParseSimulationRequest(std::string_view body);

struct RobotToAdd {
  scenario::RobotEntry robot;
  bool is_avatar = false;
};
// {name, model, x, y, z, yaw, behaviour, behaviour_constraint, movement: rigid|planar, drive, avatar};
// only the model is needed.
FieldResult<RobotToAdd> ParseRobotRequest(std::string_view body);

// {x, y, z, roll, pitch, yaw}; x and y are needed.
FieldResult<Placement> ParsePlace(std::string_view body);

// {name, model, copy_of, x, y, z, roll, pitch, yaw}; either the model or whose copy it is.
FieldResult<ObjectRequest> ParseObjectRequest(std::string_view body);

}  // namespace gsv::gateway
