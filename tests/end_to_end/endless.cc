// For tests: a behaviour that blocks forever in its code after 200 ms. Only an in-process behaviour
// can have this fault.
#include <CLI/CLI.hpp>

#include "sdk/behaviour/module.h"

namespace {

using namespace gsv;

class Endless final : public Behaviour {
 public:
  void Run(Robot& robot) override {
    robot.Drive(0.1, 0);
    robot.SleepFor(200ms);
    for (volatile bool goes_on = true; goes_on;) {
    }
  }
};

}  // namespace

GSV_BEHAVIOUR("endless", "Never returns.", Endless)
