#include "gsv/hosting/recorded_commands.h"

#include <utility>

namespace gsv::hosting {
namespace {

// After the last command it waits for ever: whether a behaviour goes on is part of a run, too.
constexpr base::SimTime kNever = base::SimTime::max() / 2;

}  // namespace

RecordedCommands::RecordedCommands(std::string name, TimedCommands commands)
    : name_(std::move(name)), place_("this process"), commands_(std::move(commands)) {}

base::Status RecordedCommands::Init(const std::shared_ptr<simulation::Agent>& agent) {
  const std::lock_guard lock(mutex_);
  agent_ = agent;
  return {};
}

base::Status RecordedCommands::Start() {
  const std::lock_guard lock(mutex_);
  if (agent_ == nullptr) {
    return base::Fail(base::ErrorCode::kBehaviour, "start comes after init", name_);
  }
  const auto clock = agent_->OpenClock();
  if (!clock) return base::Fail(clock.error());
  clock_ = *clock;
  next_ = 0;
  return {};
}

void RecordedCommands::TakeTurn(simulation::Turn& turn) {
  const std::lock_guard lock(mutex_);
  for (; next_ < commands_.size() && commands_[next_].time <= turn.now(); ++next_) {
    turn.Command(commands_[next_].command);
  }
  turn.WaitUntil(next_ < commands_.size() ? commands_[next_].time : kNever);
}

void RecordedCommands::Destroy() {
  const std::lock_guard lock(mutex_);
  agent_.reset();
}

}  // namespace gsv::hosting
