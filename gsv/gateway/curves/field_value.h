// Finds a number in a message by its key. The viewer's list of values uses the same keys
// (web/src/live/values.ts). A key consists of names of fields joined with dots, and perhaps one of
// these endings:
//
//   [I]               the number at index I of a list with at most eight numbers
//   [NAME]            the number at the index of NAME in the message's list of names (JointState)
//   .min .max .mean   minimum, maximum and mean of the finite numbers of a longer list
//   .count            the number of objects in a list
//   [0].KEY           a number in the first object of a list
//   .roll .pitch .yaw an angle of a rotation, in radians
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
