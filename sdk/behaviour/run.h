// Runs a behaviour to its end, and returns why it failed.
#pragma once

#include <exception>
#include <string>

#include "sdk/behaviour/behaviour.h"

namespace gsv {

// The reason why a run ended with an error.
struct RunFailure {
  std::string cause;  // the robot's error, or the text of the exception; empty if there is none
  bool is_exception = false;  // whether the behaviour threw the cause

  bool empty() const { return cause.empty(); }
  // Returns a line for the log, such as "scout: the behaviour threw: too far". The robot's own
  // errors name the robot already.
  std::string LogText(const std::string& robot) const;
};

// Returns the failure of a behaviour that threw this exception.
RunFailure FailureOf(const std::exception& exception);

// Calls Run() until it returns or throws. The robot's error is the cause, or else the exception.
RunFailure RunToItsEnd(Behaviour& behaviour, Robot& robot);

}  // namespace gsv
