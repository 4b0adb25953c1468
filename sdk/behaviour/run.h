// How a behaviour's run ends, wherever it runs.
#pragma once

#include <string>

#include "sdk/behaviour/behaviour.h"

namespace gsv {

// Runs it until it returns or throws. Empty, or what ended the run, after the robot's name: the
// robot's error, else what the behaviour threw.
std::string RunToItsEnd(Behaviour& behaviour, Robot& robot);

}  // namespace gsv
