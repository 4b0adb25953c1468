#include "sdk/behaviour/run.h"

namespace gsv {

std::string RunFailure::LogText(const std::string& robot) const {
  return is_exception ? robot + ": the behaviour threw: " + cause : cause;
}

RunFailure FailureOf(const std::exception& exception) {
  const std::string text = exception.what();
  return {text.empty() ? "an exception without a text" : text, true};
}

RunFailure RunToItsEnd(Behaviour& behaviour, Robot& robot) {
  RunFailure failure;
  try {
    behaviour.Run(robot);
  } catch (const std::exception& exception) {
    failure = FailureOf(exception);
  }
  if (const std::string error = robot.error(); !error.empty()) failure = {error, false};
  return failure;
}

}  // namespace gsv
