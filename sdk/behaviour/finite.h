// Checks the commands of a behaviour. A command that is NaN or infinite must not reach the robot.
#pragma once

#include <cmath>
#include <stdexcept>
#include <string>

namespace gsv {

// Returns the value. Throws std::invalid_argument (in Python: ValueError) if it is NaN or infinite.
// `what` names the value and its owner: "the position of the joint \"arm\"".
inline double Finite(double value, const std::string& what) {
  if (std::isfinite(value)) return value;
  const std::string text = std::isnan(value) ? "nan" : value > 0 ? "inf" : "-inf";
  throw std::invalid_argument(what + " must be finite, found " + text +
                              "; the command is not applied");
}

// Throws if a velocity of the base is NaN or infinite.
inline void CheckDrive(double linear, double angular, double lateral, const std::string& robot) {
  (void)Finite(linear, "the linear velocity of " + robot);
  (void)Finite(angular, "the angular velocity of " + robot);
  (void)Finite(lateral, "the lateral velocity of " + robot);
}

}  // namespace gsv
