#include "gsv/hosting/recorded_commands.h"

#include <utility>

namespace gsv::hosting {
namespace {

// After the last command the behaviour waits for ever instead of finishing, because the hash of a
// run depends on whether behaviours have finished.
constexpr base::SimTime kNever = base::SimTime::max() / 2;

}  // namespace

RecordedCommands::RecordedCommands(std::string name, TimedCommands commands, bool uses_radio)
    : name_(std::move(name)),
      place_("this process"),
      commands_(std::move(commands)),
      uses_radio_(uses_radio) {}

base::Status RecordedCommands::Init(const std::shared_ptr<simulation::Agent>& agent) {
  const base::MutexLock lock(mutex_);
  agent_ = agent;
  if (!uses_radio_) return {};
  for (const model::SensorDescription& sensor : agent->Sensors()) {
    if (sensor.type != "radio") continue;
    if (auto ok = agent->OpenSensor(sensor.name); !ok) return ok;
  }
  return {};
}

base::Status RecordedCommands::Start() {
  const base::MutexLock lock(mutex_);
  if (agent_ == nullptr) {
    return base::Fail(base::ErrorCode::kBehaviour, "start was called before init", name_);
  }
  const auto clock = agent_->OpenClock();
  if (!clock) return base::Fail(clock.error());
  clock_ = *clock;
  next_ = 0;
  return {};
}

void RecordedCommands::TakeTurn(simulation::Turn& turn) {
  const base::MutexLock lock(mutex_);
  for (; next_ < commands_.size() && commands_[next_].time <= turn.now(); ++next_) {
    Apply(commands_[next_], turn);
  }
  turn.WaitUntil(next_ < commands_.size() ? commands_[next_].time : kNever);
}

// Applies a command. A command that is no longer possible is skipped. The repeated run then differs
// from the recorded run, and the comparison of these runs reports the difference.
void RecordedCommands::Apply(const TimedCommand& command, simulation::Turn& turn) const {
  if (const auto* drive = std::get_if<world::DriveCommand>(&command.command)) {
    turn.Command(*drive);
  } else if (const auto* told = std::get_if<RecordedDeviceCommand>(&command.command)) {
    if (const auto actuator = agent_->Mounted(told->actuator)) {
      (void)turn.CommandDevice(**actuator, told->command);
    }
  } else if (const auto* sending = std::get_if<RecordedTransmission>(&command.command)) {
    if (const auto radio = agent_->Mounted(sending->radio)) {
      (void)turn.Send(**radio, sending->receiver, sending->content);
    }
  }
}

void RecordedCommands::Destroy() {
  const base::MutexLock lock(mutex_);
  agent_.reset();
}

}  // namespace gsv::hosting
