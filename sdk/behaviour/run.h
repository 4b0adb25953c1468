// Runs a behaviour to its end, and returns why it failed.
#pragma once

#include <exception>
#include <string>

#include "sdk/behaviour/behaviour.h"

namespace gsv {

// The reason why a run ended with an error.
struct RunFailure {
  std::string cause;  // the robot's error, or the text of the exception; empty if there is none
  bool is_exception = false;  // true if the behaviour threw an exception with this text

  bool empty() const { return cause.empty(); }
  // Returns a line for the log, such as "scout: the behaviour threw: too far". The robot's own
  // errors name the robot already.
  std::string LogText(const std::string& robot) const;
};

// Returns the failure of a behaviour that threw this exception.
RunFailure FailureOf(const std::exception& exception);

// Calls Run(), which ends when it returns or throws. The cause of the failure is Robot::error(). If
// that is empty, the cause is the exception. If there is neither, the result is empty.
RunFailure RunToItsEnd(Behaviour& behaviour, Robot& robot);

}  // namespace gsv
