// Saves round trips of a behaviour in lockstep. While the behaviour runs, simulated time does not
// advance. So the readings that it received at the end of its last wait stay valid, and a command
// of the base can be sent with its next wait.
//
// Threads  any.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "gsv/base/mutex.h"
#include "sdk/behaviour/robot.h"

namespace gsv::sdk {

class HeldInstant {
 public:
  // The data that a wait sends: the delayed command, and the names of the sensors that the
  // behaviour has used since its last wait.
  struct Wait {
    std::optional<DriveCommand> command;
    std::vector<std::string> sensors;
  };

  // Begins an instant. Simulated time does not advance until End().
  void Begin(SimTime now, std::vector<Reading> readings);
  // Ends the instant at the next wait. Returns the data that this wait sends.
  Wait End();

  // Returns the current instant, or nullopt after End().
  std::optional<SimTime> now() const;
  // Copies the reading of a sensor. Returns false if there is none. Notes that the behaviour uses
  // the sensor.
  bool Read(const std::string& sensor, Reading& reading);
  // Delays the command. Returns false if it must be sent now.
  bool Delay(const DriveCommand& command);
  // Returns and removes the delayed command.
  std::optional<DriveCommand> TakeCommand();

 private:
  // The reading of a sensor at this instant, and whether the behaviour has used the sensor.
  struct Use {
    bool is_used = false;  // whether the behaviour has read the sensor since its last wait
    std::optional<Reading> reading;  // nullopt if the wait returned no reading of the sensor
  };

  mutable base::Mutex mutex_;
  // The current instant; nullopt after End().
  std::optional<SimTime> now_ GSV_GUARDED_BY(mutex_);
  std::map<std::string, Use> uses_ GSV_GUARDED_BY(mutex_);  // by sensor
  // The delayed command.
  std::optional<DriveCommand> command_ GSV_GUARDED_BY(mutex_);
};

}  // namespace gsv::sdk
