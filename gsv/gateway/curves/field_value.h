// A number of a message by its key in the viewer's list (web/src/live/values.ts): names of fields
// joined with dots, and at the end
//   [I]            a number of a list that has at most eight
//   [NAME]         the number that belongs to this name in the message's list of names (JointState)
//   .min .max .mean   of the finite values of a longer list
//   .count [0]     of a list of objects
//   .roll .pitch .yaw   of a rotation, in radians
//
// Input  untrusted message and key.
#pragma once

#include <optional>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

namespace gsv::gateway::curves {

// Returns the number, or nothing. `message` comes from messages::Definition::Decode().
std::optional<double> FieldValue(const nlohmann::ordered_json& message, std::string_view key);

// Returns an angle of R = Rz(yaw) Ry(pitch) Rx(roll) in radians. `which` is "roll", "pitch" or
// "yaw"; for any other text, returns nothing.
std::optional<double> AngleOf(double x, double y, double z, double w, std::string_view which);

}  // namespace gsv::gateway::curves
