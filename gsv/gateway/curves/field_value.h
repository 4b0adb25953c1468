// One number of a message, by the key under which the viewer lists it (web/src/live/values.ts):
// the fields' names with dots between them, and at the end
//   [I]            a number of a list that has at most eight
//   [NAME]         a number that stands beside this one of the message's names (JointState)
//   .min .max .mean   of a longer list, of what is finite
//   .count [0]     of a list of things
//   .roll .pitch .yaw   of a rotation, in radians
//
// Input  hostile: message and key may hold anything.
#pragma once

#include <optional>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

namespace gsv::gateway::curves {

// `message`: as messages::Definition::Decode() gives it. Nothing: it has no such number.
std::optional<double> FieldValue(const nlohmann::ordered_json& message, std::string_view key);

// Of R = Rz(yaw) Ry(pitch) Rx(roll), in radians; `which` is "roll", "pitch" or "yaw", else nothing.
std::optional<double> AngleOf(double x, double y, double z, double w, std::string_view which);

}  // namespace gsv::gateway::curves
