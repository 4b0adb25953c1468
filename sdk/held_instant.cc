#include "sdk/held_instant.h"

#include <cmath>
#include <utility>

namespace gsv::sdk {

void HeldInstant::Begin(SimTime now, std::vector<Reading> readings) {
  const base::MutexLock lock(mutex_);
  now_ = now;
  for (Reading& reading : readings) {
    const std::string sensor = reading.sensor;
    uses_[sensor].reading = std::move(reading);
  }
}

HeldInstant::Wait HeldInstant::End() {
  const base::MutexLock lock(mutex_);
  Wait wait{std::exchange(command_, std::nullopt), {}};
  for (auto& [sensor, use] : uses_) {
    if (std::exchange(use.is_used, false)) wait.sensors.push_back(sensor);
    use.reading.reset();
  }
  now_.reset();
  return wait;
}

std::optional<SimTime> HeldInstant::now() const {
  const base::MutexLock lock(mutex_);
  return now_;
}

bool HeldInstant::Read(const std::string& sensor, Reading& reading) {
  const base::MutexLock lock(mutex_);
  Use& use = uses_[sensor];
  use.is_used = true;
  if (!use.reading) return false;
  reading = *use.reading;
  return true;
}

bool HeldInstant::Delay(const DriveCommand& command) {
  const bool is_finite = std::isfinite(command.linear) && std::isfinite(command.angular) &&
                         std::isfinite(command.lateral);
  const base::MutexLock lock(mutex_);
  // A command with a number that is not finite is sent at once, so that the simulation refuses it
  // before the behaviour continues.
  if (!now_ || !is_finite) return false;
  command_ = command;
  return true;
}

std::optional<DriveCommand> HeldInstant::TakeCommand() {
  const base::MutexLock lock(mutex_);
  return std::exchange(command_, std::nullopt);
}

}  // namespace gsv::sdk
