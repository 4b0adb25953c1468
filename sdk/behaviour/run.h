// Runs a behaviour to its end.
#pragma once

#include <string>

#include "sdk/behaviour/behaviour.h"

namespace gsv {

// Calls Run() until it returns or throws. Returns an empty text, or the robot's name and the error
// that ended the run. That is the robot's error, or else the exception.
std::string RunToItsEnd(Behaviour& behaviour, Robot& robot);

}  // namespace gsv
