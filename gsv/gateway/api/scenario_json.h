// Parses the parts of scenarios in requests: the keys of docs/formats/scenario.md that users set in
// the viewer. Requests cannot name output paths, folders or plug-ins.
//
// Errors  kInvalidArgument with the field. Unknown keys are refused.
// Bounded the number of robots.
#pragma once

#include <string_view>

#include "gsv/gateway/program/simulation_factory.h"

namespace gsv::gateway {

// Parses {name, world, mode: real_time|lockstep, real_time_factor, step, duration, seed,
// record, robots, avatars, pedestrians, ros2}. Here `record` is a boolean, whereas in a scenario
// file it is the name of the recording. Only `world` is required.
FieldResult<SimulationRequest> ParseSimulationRequest(std::string_view body);

// A request to add a robot or an avatar.
struct RobotToAdd {
  scenario::RobotEntry robot;  // the robot, as in a scenario file
  bool is_avatar = false;
};
// Parses {name, model, x, y, z, yaw, behaviour, behaviour_constraint, movement: rigid|planar,
// drive, avatar}. Either `model` or the `name` of a robot of the world file is required.
FieldResult<RobotToAdd> ParseRobotRequest(std::string_view body);

// Parses {x, y, z, roll, pitch, yaw}. x and y are required.
FieldResult<Placement> ParsePlace(std::string_view body);

// Parses {name, model, copy_of, x, y, z, roll, pitch, yaw}. Either model or copy_of is required.
FieldResult<ObjectRequest> ParseObjectRequest(std::string_view body);

}  // namespace gsv::gateway
