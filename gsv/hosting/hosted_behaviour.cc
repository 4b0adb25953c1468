#include "gsv/hosting/hosted_behaviour.h"

#include "gsv/base/log.h"

namespace gsv::hosting {

HostedBehaviour::HostedBehaviour(std::string name, BehaviourFactory factory)
    : name_(std::move(name)), place_("this process"), factory_(std::move(factory)) {}

HostedBehaviour::~HostedBehaviour() {
  const base::MutexLock lock(mutex_);
  EndRun();
}

base::Status HostedBehaviour::Guarded(const char* what, const std::function<base::Status()>& call) {
  try {
    return call();
  } catch (const std::exception& exception) {
    return base::Fail(base::ErrorCode::kBehaviour,
                      std::string("the behaviour threw in ") + what + ": " + exception.what(),
                      name_);
  }
}

base::Status HostedBehaviour::Init(const std::shared_ptr<simulation::Agent>& agent) {
  const base::MutexLock lock(mutex_);
  EndRun();
  behaviour_.reset();
  agent_ = agent;
  robot_ = std::make_unique<LocalRobot>(agent);
  return Guarded("Init", [this]() GSV_REQUIRES(mutex_) {
    behaviour_ = factory_();
    auto ok = behaviour_->Init(*robot_);
    if (!ok) behaviour_.reset();
    return ok;
  });
}

base::Status HostedBehaviour::Start() {
  const base::MutexLock lock(mutex_);
  if (behaviour_ == nullptr) {
    return base::Fail(base::ErrorCode::kBehaviour, "start was called before init", name_);
  }
  const auto clock = agent_->OpenClock();
  if (!clock) return base::Fail(clock.error());
  clock_ = *clock;
  controller_ = dynamic_cast<Controller*>(behaviour_.get());
  if (!robot_->HasOnlyFastSensors()) controller_ = nullptr;
  next_.reset();
  failure_ = {};
  if (controller_ != nullptr) return {};
  fibre_ = std::make_unique<Fibre>([this]() GSV_REQUIRES(mutex_) { Run(); });
  robot_->SetSuspend([this]() GSV_REQUIRES(mutex_) { fibre_->Suspend(); });
  return {};
}

// An exception of the behaviour ends the behaviour, not the simulation.
void HostedBehaviour::Run() { failure_ = RunToItsEnd(*behaviour_, *robot_); }

void HostedBehaviour::EndTurn(simulation::Turn& turn) {
  if (failure_.empty() && robot_ != nullptr) failure_.cause = robot_->error();
  if (failure_.empty()) return turn.Finish();
  spdlog::error("{}", failure_.LogText(robot_ != nullptr ? robot_->name() : name_));
  turn.Fail(failure_.cause);
}

// robot_ and controller_ need no lock: they do not change while the simulation runs turns of
// behaviours.
void HostedBehaviour::PrefetchTurn() const GSV_NO_THREAD_SAFETY_ANALYSIS {
  __builtin_prefetch(robot_.get());
  __builtin_prefetch(controller_);
  __builtin_prefetch(sweeps_.load(std::memory_order_relaxed));
}

void HostedBehaviour::TakeTurn(simulation::Turn& turn) {
  const base::MutexLock lock(mutex_);
  if (robot_ == nullptr || !robot_->IsRunning()) return EndTurn(turn);
  robot_->SetTurn(&turn);
  if (controller_ != nullptr) {
    Control(turn);
  } else if (fibre_ != nullptr) {
    fibre_->Resume();
    if (fibre_->has_ended()) {
      fibre_.reset();
      robot_->End();
      EndTurn(turn);
    }
  }
  robot_->SetTurn(nullptr);
  sweeps_.store(robot_->sweeps(), std::memory_order_relaxed);
}

// The result is constructed in place: a copy would have to wait until the processor has written the
// command's values to its cache.
DriveCommand HostedBehaviour::ControlOnce() {
  const std::vector<Reading>& readings = robot_->ReadOpenSensors();
  try {
    if (robot_->IsRunning()) return controller_->Control(readings);
  } catch (const std::exception& exception) {
    failure_ = FailureOf(exception);
    robot_->End();
  }
  return {};
}

// Executes a controller's turn: the part of Controller::Run() between two waits.
void HostedBehaviour::Control(simulation::Turn& turn) {
  if (!next_) {
    next_ = turn.now() + controller_->period();
    robot_->Command({});
  } else {
    robot_->Command(ControlOnce());
    *next_ += controller_->period();
  }
  if (!robot_->IsRunning()) return EndTurn(turn);
  turn.CountExchange();
  turn.WaitUntil(*next_);
}

void HostedBehaviour::EndRun() {
  if (robot_ != nullptr) robot_->End();
  while (fibre_ != nullptr && !fibre_->has_ended()) fibre_->Resume();
  fibre_.reset();
  controller_ = nullptr;
}

base::Status HostedBehaviour::Stop() {
  const base::MutexLock lock(mutex_);
  EndRun();
  return {};
}

base::Status HostedBehaviour::Pause() {
  const base::MutexLock lock(mutex_);
  return Guarded("Paused", [this]() GSV_REQUIRES(mutex_) -> base::Status {
    if (behaviour_ != nullptr) behaviour_->Paused();
    return {};
  });
}

base::Status HostedBehaviour::Resume() {
  const base::MutexLock lock(mutex_);
  return Guarded("Resumed", [this]() GSV_REQUIRES(mutex_) -> base::Status {
    if (behaviour_ != nullptr) behaviour_->Resumed();
    return {};
  });
}

void HostedBehaviour::Destroy() {
  const base::MutexLock lock(mutex_);
  EndRun();
  behaviour_.reset();
  robot_.reset();
  agent_.reset();
}

}  // namespace gsv::hosting
