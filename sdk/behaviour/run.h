// How a behaviour's run ends, wherever it runs.
#pragma once

#include <string>

#include "sdk/behaviour/behaviour.h"

namespace gsv {

// Runs it until it returns or throws. Empty, or the error that ended the run: the robot's, else
// what the behaviour threw.
std::string RunToItsEnd(Behaviour& behaviour, Robot& robot);

}  // namespace gsv
