// A behaviour that repeats recorded commands, each at its recorded instant.
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "gsv/base/mutex.h"
#include "gsv/simulation/robots/local_behaviour.h"

namespace gsv::hosting {

// A command to an actuator.
struct RecordedDeviceCommand {
  std::string actuator;
  world::DeviceCommand command;
};

// A message of a radio.
struct RecordedTransmission {
  // names of the sending radio and of the receiving robot, and the text
  std::string radio, receiver, content;
};

// A recorded command, and the instant at which it was given.
struct TimedCommand {
  base::SimTime time{0};
  std::variant<world::DriveCommand, RecordedDeviceCommand, RecordedTransmission> command;
};
using TimedCommands = std::vector<TimedCommand>;  // Commands in ascending order of time.

class RecordedCommands final : public simulation::LocalBehaviour {
 public:
  // `name` is the name of the recorded behaviour. If `uses_radio` is true, the robot's radios are
  // on from the start.
  RecordedCommands(std::string name, TimedCommands commands, bool uses_radio = false);

  base::Status Init(const std::shared_ptr<simulation::Agent>& agent) override;
  base::Status Start() override;
  base::Status Stop() override { return {}; }
  base::Status Pause() override { return {}; }
  base::Status Resume() override { return {}; }
  void Destroy() override;
  const std::string& name() const override { return name_; }
  const std::string& place() const override { return place_; }

  simulation::ClockId clock() const override { return clock_; }
  void TakeTurn(simulation::Turn& turn) override;

 private:
  // Sends a recorded command in a turn.
  void Apply(const TimedCommand& command, simulation::Turn& turn) const GSV_REQUIRES(mutex_);

  const std::string name_, place_;
  const TimedCommands commands_;
  const bool uses_radio_;

  base::Mutex mutex_;  // held during a turn
  std::shared_ptr<simulation::Agent> agent_ GSV_GUARDED_BY(mutex_);
  std::atomic<simulation::ClockId> clock_ = 0;
  std::size_t next_ GSV_GUARDED_BY(mutex_) = 0;  // index of the next command to repeat
};

}  // namespace gsv::hosting
