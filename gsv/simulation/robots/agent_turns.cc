// The part of RobotAgent that takes and applies the turns of a local behaviour.
#include <utility>

#include "gsv/simulation/robots/robot_agent.h"

namespace gsv::simulation {
namespace {

// The number of cache lines of a local behaviour and of a body that are loaded before a turn.
constexpr std::size_t kBehaviourLines = 2, kBodyLines = 2;

}  // namespace

void RobotAgent::MakeReady() {
  is_blocked_ = false;
  shared_->ready.push_back(this);
}

// The next three functions need no lock. The stepping thread has locked the world now, and only
// with this lock can the index of the body change. The behaviour can change only before the run
// starts.
void RobotAgent::PrefetchBehaviour(const world::Snapshot& snapshot) const
    GSV_NO_THREAD_SAFETY_ANALYSIS {
  PrefetchLines(local_, kBehaviourLines);
  if (body_ < 0) return;
  PrefetchLines(&snapshot.state.bodies[static_cast<std::size_t>(body_)], 1);
  PrefetchLines(&snapshot.layout->bodies[static_cast<std::size_t>(body_)], kBodyLines);
}

void RobotAgent::PrefetchTurn() const GSV_NO_THREAD_SAFETY_ANALYSIS { local_->PrefetchTurn(); }

void RobotAgent::TakeTurn(const Turn::Instant& instant,
                          sensing::Sampling& sampling) GSV_NO_THREAD_SAFETY_ANALYSIS {
  sampling.MoveTo(body_);
  turn_.Begin(instant, sampling);
  const WallTime began = instant.is_timed ? WallNow() : CoarseWallNow();
  turn_began_.store(began, std::memory_order_release);
  local_->TakeTurn(turn_);
  turn_clock_ = local_->clock();
  turn_began_.store(WallTime(), std::memory_order_release);
  if (instant.is_timed) turn_took_ = WallNow() - began;
}

std::optional<WallTime> RobotAgent::in_turn_since() const {
  const WallTime began = turn_began_;
  return began == WallTime() ? std::nullopt : std::optional(began);
}

RobotAgent::UsualEnd RobotAgent::ApplyUsualTurn(SimTime now) {
  const ClockId clock = turn_clock_;
  const auto* const waiting = std::get_if<Turn::Waiting>(&turn_.end_);
  if (waiting == nullptr || waiting->until <= now) return {};
  if (is_removed_ || fate_ != Fate::kAlive || death_reported_ || has_given_up_) return {};
  // If the agent has a second clock, that clock may still run.
  if (clocks_.count() != 1 || !clocks_.IsOpen(clock) || clocks_.IsWaiting(clock)) return {};
  UsualEnd end{.is_usual = true, .until = waiting->until};
  clocks_.set_last_cycle(clock, clocks_.last_cycle(clock) + turn_.exchanges_);
  if (!is_commanded_ && turn_.commands_.has_only_drive()) {
    end.has_drive = true;
    end.drive = turn_.commands_.drive()->command;
  } else if (!turn_.commands_.empty()) {
    MergeTurnCommands();
    end.has_command = !std::exchange(is_commanded_, true);
  }
  clocks_.WaitUntil(clock, waiting->until, now);
  end.was_counted = std::exchange(is_counted_, false);
  return end;
}

void RobotAgent::MergeTurnCommands() {
  RobotCommands& commands = turn_.commands_;
  if (commands.drive() && turn_.exchanges_ > 0) commands.drive()->clock = turn_clock_;
  commands_.Merge(std::move(commands));
}

std::function<void()> RobotAgent::ApplyTurn() {
  const ClockId clock = turn_clock_;
  if (is_removed_ || fate_ != Fate::kAlive || !clocks_.IsOpen(clock)) return {};
  clocks_.set_last_cycle(clock, clocks_.last_cycle(clock) + turn_.exchanges_);
  if (!turn_.commands_.empty()) {
    (void)Commands();
    MergeTurnCommands();
  }
  if (auto* blocked = std::get_if<Turn::Blocked>(&turn_.end_)) {
    is_blocked_ = true;
    return std::move(blocked->work);
  }
  if (const auto* waiting = std::get_if<Turn::Waiting>(&turn_.end_)) {
    if (!BeginWait(clock, waiting->until)) MakeReady();
  } else if (const auto* failed = std::get_if<Turn::Failed>(&turn_.end_)) {
    ReportFailure(failed->reason);
  } else {
    clocks_.Close(clock);
    UpdateRunningCount();
  }
  return {};
}

bool RobotAgent::ApplyDriveCommand(world::State& state) {
  if (!commands_.has_only_drive()) return false;
  ApplyDrive(commands_.drive()->command, state);
  commands_.drive().reset();
  is_commanded_ = false;
  return true;
}

RobotCommands RobotAgent::TakeCommands() {
  is_commanded_ = false;
  RobotCommands commands = commands_.Take();
  if (commands.drive() && !has_motor_) commands.SetDrive({});
  for (const int joint : lost_joints_) commands.ForgetJoint(joint);
  return commands;
}

}  // namespace gsv::simulation
