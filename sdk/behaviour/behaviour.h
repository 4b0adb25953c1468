// The base class of behaviours. A behaviour drives one robot. It runs as a program anywhere on the
// network, or inside gsv (see module.h).
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "sdk/behaviour/robot.h"

namespace gsv {

// A behaviour derives from this class and implements Run(), or derives from Controller and
// implements Control().
class Behaviour {
 public:
  virtual ~Behaviour() = default;

  // Called before Run(), when the behaviour gets its robot. Open sensors here. If it returns an
  // error, the simulation does not add the robot, or does not give this behaviour to an existing
  // robot.
  virtual base::Status Init(Robot& /*robot*/) { return {}; }
  // Runs until robot.SleepFor() or another wait returns false, or until the work is done.
  virtual void Run(Robot& robot) = 0;

  // Called when the simulation pauses or resumes. A behaviour that sleeps on the robot's clock need
  // not override these functions.
  virtual void Paused() {}
  virtual void Resumed() {}
};

// A behaviour that never blocks. It computes a command from readings once per period.
class Controller : public Behaviour {
 public:
  explicit Controller(SimTime period) : period_(period) {}

  // Returns the command of the base for the next period. `readings` are the readings of all open
  // sensors.
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

// Makes the behaviour of one robot.
using BehaviourFactory = std::function<std::unique_ptr<Behaviour>()>;

}  // namespace gsv
