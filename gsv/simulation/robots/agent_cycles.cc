// The part of RobotAgent that exchanges control cycles by shared memory.
#include <algorithm>
#include <utility>

#include "gsv/simulation/robots/robot_agent.h"

namespace gsv::simulation {

base::Result<CycleMemory> RobotAgent::ShareMemory(ClockId clock) {
  AgentCallLock lock(*shared_);
  if (auto ok = CheckCanCommand(); !ok) return base::Fail(ok.error());
  if (auto ok = CheckClock(clock); !ok) return base::Fail(ok.error());
  if (shared_->channels.bell() == nullptr) {
    if (auto ok = shared_->channels.Prepare(); !ok) return base::Fail(ok.error());
    shared_->changed.Use(*shared_->channels.bell());
  }
  auto added = shared_->channels.Add(*this, weak_from_this(), clock);
  if (!added) return base::Fail(added.error());
  std::erase_if(channels_, [](const auto& channel) { return channel->is_closed(); });
  channels_.push_back(added->channel);
  return added->memory;
}

// Does the first part of Exchange() and SleepAndRead(), until they wait. If this part fails, the
// client repeats the cycle by a call, and the call reports the error.
void RobotAgent::BeginCycle(const std::shared_ptr<CycleChannel>& channel,
                            EventSignaler::Events& due) {
  auto request = channel->Take();
  if (!request) return;
  const exchange::CycleRequest& cycle = request->cycle;
  const ClockId clock = channel->clock();
  const bool is_exchange = cycle.cycle != 0;
  const world::DriveCommand command{cycle.linear, cycle.lateral, cycle.angular};
  const bool is_valid = CheckAlive() && CheckClock(clock) && CheckCanCommand() &&
                        (is_exchange ? cycle.cycle == clocks_.last_cycle(clock) + 1
                                     : shared_->mode == Mode::kLockstep) &&
                        (cycle.has_command == 0 || OfferDrive(is_exchange ? clock : 0, command));
  if (!is_valid) return channel->Refuse();
  if (is_exchange) clocks_.set_last_cycle(clock, cycle.cycle);
  const bool waits = BeginWait(clock, SimTime(cycle.instant_ns));
  channel->Accept(*std::move(request));
  if (waits) return;
  SetDue(*channel);
  due.push_back(channel);
}

void RobotAgent::SetDue(CycleChannel& channel) {
  channel.SetDue(shared_->now, shared_->mode == Mode::kLockstep && BlocksStep());
}

void RobotAgent::CollectWoken(const Woken& woken, EventSignaler::Events& due) {
  if (waiting_calls_ > 0) due.push_back(wait_event());
  if (woken.has_died) return shared_->channels.Close(*this);
  for (const auto& channel : channels_) {
    if (!channel->is_waiting() || clocks_.IsWaiting(channel->clock())) continue;
    SetDue(*channel);
    due.push_back(channel);
  }
}

CycleChannel::Readings RobotAgent::WriteReadings(const CycleChannel::Request& request,
                                                 exchange::ContentWriter& content) {
  const bool is_exchange = request.cycle.cycle != 0;
  std::vector<std::pair<MountedSensorPtr, sensing::Reading>> readings;
  for (const MountedSensorPtr& sensor : rack_.OpenSensors()) {
    if (is_exchange) {
      if (sensor->takes_long()) return CycleChannel::Readings::kAlwaysByCall;
    } else if (sensor->takes_long() || std::find(request.sensors.begin(), request.sensors.end(),
                                                 sensor->name()) == request.sensors.end()) {
      continue;
    }
    auto reading = Sample(*sensor);
    if (!reading && !is_exchange) continue;
    if (!reading) return CycleChannel::Readings::kByCall;
    if (reading->image != nullptr) return CycleChannel::Readings::kAlwaysByCall;
    readings.emplace_back(sensor, *std::move(reading));
  }
  content.Add(std::uint64_t{readings.size()});
  for (const auto& [sensor, reading] : readings) {
    content.Add(std::string_view(sensor->name()));
    content.Add(std::int64_t{reading.time.count()});
    content.Add(std::span<const double>(reading.values.data(), reading.values.size()));
    content.Add(std::uint64_t{reading.labels != nullptr ? reading.labels->size() : 0});
    if (reading.labels == nullptr) continue;
    for (const std::string& label : *reading.labels) content.Add(std::string_view(label));
  }
  if (!content.ok()) return CycleChannel::Readings::kAlwaysByCall;
  for (const auto& [sensor, reading] : readings) sensor->CountReading();
  return CycleChannel::Readings::kWritten;
}

void RobotAgent::CloseChannel(ClockId clock) {
  const AgentCallLock lock(*shared_);
  shared_->channels.Close(*this, clock);
}

}  // namespace gsv::simulation
