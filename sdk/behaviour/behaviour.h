// What moves a robot: write one of these, and it runs as a program of its own anywhere on the
// network, or inside gsv (see module.h).
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "sdk/behaviour/robot.h"

namespace gsv {

class Behaviour {
 public:
  virtual ~Behaviour() = default;

  // The robot is there, time does not run yet: open sensors here. An error refuses the robot.
  virtual base::Status Init(Robot& /*robot*/) { return {}; }
  // Runs until robot.SleepFor() and the like return false, or until the work is done.
  virtual void Run(Robot& robot) = 0;

  // Told, not asked: a behaviour that sleeps on the robot's clock need not do anything.
  virtual void Paused() {}
  virtual void Resumed() {}
};

// A behaviour that never blocks: readings in, command out, once a period.
class Controller : public Behaviour {
 public:
  explicit Controller(SimTime period) : period_(period) {}

  virtual DriveCommand Control(const std::vector<Reading>& readings) = 0;
  SimTime period() const { return period_; }

  void Run(Robot& robot) final {
    std::vector<Reading> readings;
    DriveCommand command;
    for (SimTime next = robot.Now() + period_; robot.Exchange(command, next, readings);
         next += period_) {
      command = Control(readings);
    }
  }

 private:
  SimTime period_;
};

using BehaviourFactory = std::function<std::unique_ptr<Behaviour>()>;

}  // namespace gsv
