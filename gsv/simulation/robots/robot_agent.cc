#include "gsv/simulation/robots/robot_agent.h"

#include <utility>

#include "gsv/base/log_text.h"

namespace gsv::simulation {
namespace {

constexpr int kMaxClocks = 64;
// Maximum number of bytes of the reason that a behaviour gives for ending.
constexpr std::size_t kMaxReasonLength = 1000;

base::Error NotRunning(const std::string& robot) {
  return {base::ErrorCode::kNotRunning,
          "in lockstep a behaviour may command and read only while it runs, and this one waits",
          robot};
}

}  // namespace

RobotAgent::RobotAgent(std::string robot, std::shared_ptr<const model::Model> model, bool is_avatar,
                       std::shared_ptr<SharedState> shared)
    : shared_(std::move(shared)),
      robot_(std::move(robot)),
      model_(std::move(model)),
      footprint_radius_(model::FootprintRadius(*model_)),
      is_avatar_(is_avatar),
      rack_(robot_, model_, shared_->designs) {
  for (const SensorDesignPtr& design : *shared_->designs.Of(model_)) {
    shared_->history.Use(design->cadence);
  }
}

void RobotAgent::SetBehaviour(std::shared_ptr<BehaviourPort> behaviour) {
  behaviour_ = std::move(behaviour);
  local_ = behaviour_ != nullptr ? behaviour_->local() : nullptr;
  UpdateRunningCount();
}

void RobotAgent::UpdateRunningCount() {
  const bool holds_up = BlocksStep();
  if (holds_up == is_counted_) return;
  is_counted_ = holds_up;
  shared_->running += holds_up ? 1 : -1;
  const bool is_waited_for = shared_->mode == Mode::kLockstep;
  // The stepping thread is woken when the last running agent waits. If there are channels, it is
  // also woken while other agents run: a client with a channel rings the Bell only if it is the
  // last one that posts its request. An agent that waits by a call never rings. So this call
  // replaces a ring.
  if (!is_waited_for || (shared_->running > 0 && shared_->channels.empty())) return;
  if (shared_->is_timed) shared_->held_up_by = robot_;
  shared_->changed.notify_all();
}

RobotCommands& RobotAgent::Commands() {
  if (!std::exchange(is_commanded_, true)) shared_->commanded.push_back(this);
  return commands_;
}

base::Status RobotAgent::CheckAlive() const {
  if (is_removed_) return base::Fail(base::ErrorCode::kEnded, "the robot has been removed", robot_);
  if (!shared_->end_reason.empty()) {
    return base::Fail(base::ErrorCode::kEnded, shared_->end_reason, robot_);
  }
  if (fate_ != Fate::kAlive || has_given_up_) {
    return base::Fail(base::ErrorCode::kEnded, detail_, robot_);
  }
  return {};
}

base::Status RobotAgent::CheckCanCommand() const {
  if (auto alive = CheckAlive(); !alive) return alive;
  const bool waits = shared_->mode == Mode::kLockstep && started_ && behaviour_ != nullptr &&
                     clocks_.HasOpened() && !clocks_.IsFinished() && !clocks_.IsRunning();
  return waits ? base::Fail(NotRunning(robot_)) : base::Status();
}

base::Status RobotAgent::CheckClock(ClockId clock) const {
  if (clocks_.IsOpen(clock)) return {};
  return base::Fail(base::ErrorCode::kEnded, "the clock is closed", robot_);
}

base::Result<ClockId> RobotAgent::OpenClock() {
  AgentCallLock lock(*shared_);
  if (auto ok = CheckCanCommand(); !ok) return base::Fail(ok.error());
  const ClockId clock = clocks_.Open();
  if (clocks_.count() > kMaxClocks) {
    clocks_.Close(clock);
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "an agent has at most 64 clocks open; close one first", robot_);
  }
  UpdateRunningCount();
  return clock;
}

base::Status RobotAgent::CloseClock(ClockId clock) {
  AgentCallLock lock(*shared_);
  if (auto ok = CheckClock(clock); !ok) return ok;
  // if the behaviour has given up, its clocks keep their state
  if (has_given_up_) return CheckAlive();
  clocks_.Close(clock);
  shared_->channels.Close(*this, clock);
  wait_event_.Open();
  UpdateRunningCount();
  return {};
}

base::Status RobotAgent::GiveUp(ClockId clock, const std::string& reason) {
  AgentCallLock lock(*shared_);
  if (auto ok = CheckAlive(); !ok) return ok;
  if (auto ok = CheckClock(clock); !ok) return ok;
  ReportFailure(reason);
  return {};
}

SimTime RobotAgent::Now() const {
  const AgentCallLock lock(*shared_);
  return shared_->now;
}

base::Result<Wait> RobotAgent::SleepUntil(ClockId clock, SimTime until,
                                          std::chrono::milliseconds lease) {
  AgentCallLock lock(*shared_);
  if (auto ok = CheckAlive(); !ok) return base::Fail(ok.error());
  if (auto ok = CheckClock(clock); !ok) return base::Fail(ok.error());
  return WaitOn(lock, clock, until, lease);
}

bool RobotAgent::BeginWait(ClockId clock, SimTime until) {
  const bool waits_already = clocks_.IsWaitingUntil(clock, until);
  if (clocks_.WaitUntil(clock, until, shared_->now)) return false;
  if (!waits_already) shared_->sleepers.Add(until, this);
  UpdateRunningCount();
  return true;
}

// The thread-safety analysis does not know that `lock` is the lock that the caller holds.
base::Result<Wait> RobotAgent::WaitOn(AgentCallLock& lock, ClockId clock, SimTime until,
                                      std::chrono::milliseconds lease)
    GSV_NO_THREAD_SAFETY_ANALYSIS {
  if (!BeginWait(clock, until)) return Wait::kReached;
  const WallTime lease_ends = WallNow() + lease;
  for (;;) {
    const std::uint64_t signals = wait_event_.signals();
    ++waiting_calls_;
    lock.unlock();
    const bool was_opened = wait_event_.WaitAfter(signals, lease_ends);
    lock.lock();
    --waiting_calls_;
    if (auto ok = CheckAlive(); !ok) return base::Fail(ok.error());
    if (auto ok = CheckClock(clock); !ok) return base::Fail(ok.error());
    if (!clocks_.IsWaiting(clock)) return Wait::kReached;
    if (!was_opened) return Wait::kNotYet;
  }
}

base::Result<Exchanged> RobotAgent::Exchange(ClockId clock, std::uint64_t cycle,
                                             std::optional<world::DriveCommand> command,
                                             SimTime until, std::chrono::milliseconds lease) {
  Exchanged exchanged;
  {
    AgentCallLock lock(*shared_);
    if (auto ok = CheckAlive(); !ok) return base::Fail(ok.error());
    if (auto ok = CheckClock(clock); !ok) return base::Fail(ok.error());
    const std::uint64_t last = clocks_.last_cycle(clock);
    if (cycle == last + 1) {
      if (auto ok = CheckCanCommand(); !ok) return base::Fail(ok.error());
      if (command) {
        if (auto ok = OfferDrive(clock, *command); !ok) return base::Fail(ok.error());
      }
      clocks_.set_last_cycle(clock, cycle);
    } else if (cycle != last || cycle == 0) {
      return base::Fail(
          base::ErrorCode::kInvalidArgument,
          "exchange cycle " + std::to_string(cycle) + " does not follow " + std::to_string(last),
          robot_);
    }
    auto wait = WaitOn(lock, clock, until, lease);
    if (!wait) return base::Fail(wait.error());
    exchanged.wait = *wait;
    exchanged.now = shared_->now;
  }
  if (exchanged.wait == Wait::kReached) {
    auto readings = ReadOpenSensors();
    if (!readings) return base::Fail(readings.error());
    exchanged.readings = *std::move(readings);
  }
  return exchanged;
}

base::Result<std::vector<NamedReading>> RobotAgent::ReadOpenSensors() {
  std::vector<NamedReading> readings;
  for (const MountedSensorPtr& sensor : rack_.OpenSensors()) {
    auto reading = Sample(*sensor);
    if (!reading) return base::Fail(reading.error());
    sensor->CountReading();
    readings.push_back({sensor->name(), *std::move(reading)});
  }
  return readings;
}

base::Result<Exchanged> RobotAgent::SleepAndRead(ClockId clock,
                                                 std::optional<world::DriveCommand> command,
                                                 SimTime until, std::chrono::milliseconds lease,
                                                 const std::set<std::string>& sensors) {
  Exchanged exchanged;
  {
    AgentCallLock lock(*shared_);
    if (auto ok = CheckAlive(); !ok) return base::Fail(ok.error());
    if (auto ok = CheckClock(clock); !ok) return base::Fail(ok.error());
    if (command) {
      if (auto ok = CheckCanCommand(); !ok) return base::Fail(ok.error());
      if (auto ok = OfferDrive(0, *command); !ok) return base::Fail(ok.error());
    }
    auto wait = WaitOn(lock, clock, until, lease);
    if (!wait) return base::Fail(wait.error());
    exchanged.wait = *wait;
    exchanged.now = shared_->now;
    exchanged.holds_time =
        *wait == Wait::kReached && shared_->mode == Mode::kLockstep && BlocksStep();
  }
  if (!exchanged.holds_time || sensors.empty()) return exchanged;
  for (const MountedSensorPtr& sensor : rack_.OpenSensors()) {
    if (sensor->takes_long() || !sensors.contains(sensor->name())) continue;
    auto reading = Sample(*sensor);
    if (!reading) continue;
    sensor->CountReading();
    exchanged.readings.push_back({sensor->name(), *std::move(reading)});
  }
  return exchanged;
}

base::Status RobotAgent::OfferDrive(ClockId clock, const world::DriveCommand& command) {
  if (!world::IsFinite(command)) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "the command has a value that is not finite", robot_);
  }
  Commands().OfferDrive({clock, command});
  return {};
}

base::Status RobotAgent::Command(const world::DriveCommand& command) {
  AgentCallLock lock(*shared_);
  if (auto ok = CheckCanCommand(); !ok) return ok;
  return OfferDrive(0, command);
}

void RobotAgent::MarkStarted() {
  started_ = true;
  running_since_ = WallNow();
  UpdateRunningCount();
}

bool RobotAgent::BlocksStep() const {
  // For a local behaviour, time_managed() is always true. It is not called, for speed.
  return started_ && behaviour_ != nullptr && is_alive() && !is_removed_ && clocks_.IsRunning() &&
         (local_ != nullptr || behaviour_->time_managed());
}

bool RobotAgent::IsAtWork() const {
  return BlocksStep() && (!is_hosted() || in_turn_since() || is_blocked_);
}

RobotAgent::Woken RobotAgent::Wake(SimTime now, WallTime wall_now) {
  const Woken woken = WakeForTurn(now, wall_now);
  if (woken.has_passed && !woken.has_died && is_hosted()) MakeReady();
  return woken;
}

RobotAgent::Woken RobotAgent::WakeForTurn(SimTime now, WallTime wall_now) {
  const bool woke = clocks_.Wake(now);
  const bool dies =
      death_reported_ && fate_ == Fate::kAlive && (woke || clocks_.IsRunning() || has_given_up_);
  if (dies) {
    fate_ = Fate::kDead;
    StopDriving();
  }
  if (woke) running_since_ = wall_now;
  if (woke || dies) UpdateRunningCount();
  return {woke || dies, dies};
}

void RobotAgent::MarkUnresponsive(std::string detail) {
  fate_ = Fate::kUnresponsive;
  detail_since_ = shared_->now;
  detail_ = std::move(detail);
  StopDriving();
  shared_->channels.Close(*this);
  wait_event_.Open();
  UpdateRunningCount();
}

void RobotAgent::ReportDeath(std::string detail) {
  death_reported_ = true;
  detail_since_ = shared_->now;
  detail_ = std::move(detail);
  shared_->has_reported_deaths = true;
  UpdateRunningCount();
}

void RobotAgent::ReportFailure(std::string_view reason) {
  if (death_reported_) return;
  has_given_up_ = true;
  cause_ = base::LogLine(reason, kMaxReasonLength, {});
  ReportDeath("its run ended with an error: " + cause_);
  shared_->given_up.emplace_back(robot_, DescribeInEvents() + ": " + detail_);
}

void RobotAgent::LoseMotor() {
  has_motor_ = false;
  StopDriving();
}

void RobotAgent::LoseJoint(int joint) {
  lost_joints_.insert(joint);
  commands_.ForgetJoint(joint);
}

void RobotAgent::MarkRemoved() {
  is_removed_ = true;
  shared_->channels.Close(*this);
  wait_event_.Open();
  UpdateRunningCount();
}

void RobotAgent::ResetClocks() {
  shared_->channels.Close(*this);
  clocks_ = AgentClocks();
  commands_ = {};
  is_commanded_ = false;
  started_ = false;
  has_motor_ = true;
  lost_joints_.clear();
  death_reported_ = false;
  has_given_up_ = false;
  fate_ = Fate::kAlive;
  detail_.clear();
  cause_.clear();
  UpdateRunningCount();
}

void RobotAgent::FillStatus(RobotStatus& status) const {
  status.name = robot_;
  status.model = model_->name;
  status.behaviour = behaviour_ != nullptr ? behaviour_->name() : "";
  status.behaviour_place = behaviour_ != nullptr ? behaviour_->place() : "";
  status.is_avatar = is_avatar_;
  status.detail = detail_;
  status.cause = cause_;
  status.detail_since = detail_since_;
  status.readings = rack_.readings_by_type();
  if (behaviour_ == nullptr) {
    status.phase = AgentPhase::kNone;
  } else if (fate_ == Fate::kDead || death_reported_) {
    status.phase = AgentPhase::kDead;
  } else if (fate_ == Fate::kUnresponsive) {
    status.phase = AgentPhase::kUnresponsive;
  } else if (!started_) {
    status.phase = AgentPhase::kInitialised;
  } else if (clocks_.IsFinished()) {
    status.phase = AgentPhase::kFinished;
  } else {
    status.phase = clocks_.IsRunning() ? AgentPhase::kRunning : AgentPhase::kWaiting;
    const bool is_expected_to_wait = clocks_.IsRunning() && behaviour_->time_managed();
    if (is_expected_to_wait) status.running_for = WallNow() - running_since_;
  }
}

std::string RobotAgent::Describe() const {
  if (behaviour_ == nullptr) return robot_;
  return robot_ + " (" + behaviour_->name() + " on " + behaviour_->place() + ")";
}

std::string RobotAgent::DescribeInEvents() const {
  return behaviour_ == nullptr ? robot_ : robot_ + " (" + behaviour_->name() + ")";
}

void RobotAgent::AddToHash(base::Hash& hash) const {
  hash.Add(std::string_view(robot_));
  hash.Add(std::uint64_t{behaviour_ != nullptr});
  hash.Add(static_cast<std::uint64_t>(fate_));
  clocks_.AddToHash(hash);
}

}  // namespace gsv::simulation
