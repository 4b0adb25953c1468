// Checks the commands of a behaviour. A command that is NaN or infinite must not reach the robot.
//
// Errors  std::invalid_argument (in Python: ValueError), which names the value and its owner.
#pragma once

#include <cmath>
#include <stdexcept>
#include <string>

namespace gsv {

// Throws because a value is not finite.
[[noreturn]] inline void RejectValue(double value, const std::string& quantity,
                                     const std::string& owner) {
  const std::string text = std::isnan(value) ? "nan" : value > 0 ? "inf" : "-inf";
  throw std::invalid_argument("the " + quantity + " of " + owner + " must be finite, found " +
                              text + "; the command is not applied");
}

// Throws if the position (rad or m), velocity or effort of a joint is NaN or infinite.
inline void CheckJoint(double value, const char* quantity, const std::string& joint) {
  if (!std::isfinite(value)) RejectValue(value, quantity, "the joint \"" + joint + "\"");
}

// Throws if a velocity of the base (m/s or rad/s) is NaN or infinite.
inline void CheckDrive(double linear, double angular, double lateral, const std::string& robot) {
  if (!std::isfinite(linear)) RejectValue(linear, "linear velocity", robot);
  if (!std::isfinite(angular)) RejectValue(angular, "angular velocity", robot);
  if (!std::isfinite(lateral)) RejectValue(lateral, "lateral velocity", robot);
}

}  // namespace gsv
