// A number of a message by its key in the viewer's list (web/src/live/values.ts): names of fields
// joined with dots, and at the end
//   [I]            a number of a list that has at most eight
//   [NAME]         a number that stands beside this one of the message's names (JointState)
//   .min .max .mean   of the finite values of a longer list
//   .count [0]     of a list of things
//   .roll .pitch .yaw   of a rotation, in radians
//
// Input  untrusted message and key.
#pragma once

#include <optional>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

namespace gsv::gateway::curves {

// `message`: from messages::Definition::Decode(). Nothing if it has no such number.
std::optional<double> FieldValue(const nlohmann::ordered_json& message, std::string_view key);

// An angle of R = Rz(yaw) Ry(pitch) Rx(roll), in radians; `which` is "roll", "pitch" or "yaw",
// otherwise nothing.
std::optional<double> AngleOf(double x, double y, double z, double w, std::string_view which);

}  // namespace gsv::gateway::curves
