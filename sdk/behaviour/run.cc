#include "sdk/behaviour/run.h"

#include <exception>

namespace gsv {

std::string RunToItsEnd(Behaviour& behaviour, Robot& robot) {
  std::string thrown;
  try {
    behaviour.Run(robot);
  } catch (const std::exception& exception) {
    thrown = robot.name() + ": the behaviour threw: " + exception.what();
  }
  const std::string error = robot.error();
  return error.empty() ? thrown : error;
}

}  // namespace gsv
