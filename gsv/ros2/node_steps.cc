#include "gsv/ros2/node_steps.h"

#include <utility>

#include "gsv/base/log.h"

namespace gsv::ros2 {
namespace {

// The period, in wall-clock time, at which /clock is sent again.
constexpr std::chrono::milliseconds kRepeatPeriod{100};
constexpr std::chrono::milliseconds kStepLease{1000};

}  // namespace

void NodeSteps::Open(const std::string& robot, bool is_open) {
  {
    const base::MutexLock lock(mutex_);
    robots_[robot] = {.is_open = is_open};
  }
  changed_.notify_all();
}

bool NodeSteps::IsOpen(const std::string& robot) const {
  const base::MutexLock lock(mutex_);
  const auto found = robots_.find(robot);
  return found != robots_.end() && found->second.is_open;
}

void NodeSteps::Offer(const std::string& robot, base::SimTime stamp,
                      const world::DriveCommand& command) {
  {
    const base::MutexLock lock(mutex_);
    Robot& there = robots_[robot];
    if (there.awaited && stamp < *there.awaited && !there.has_warned) {
      there.has_warned = true;
      spdlog::warn(
          "{}: a command of ROS 2 has the time {} s and is ignored, because the step waits for "
          "a command with the time of the last /clock, {} s",
          robot, base::ToSeconds(stamp), base::ToSeconds(*there.awaited));
    }
    if (there.awaited && stamp < *there.awaited) return;
    there.stamp = stamp;
    there.command = command;
  }
  changed_.notify_all();
}

std::optional<world::DriveCommand> NodeSteps::Await(const std::string& robot, base::SimTime time) {
  base::MutexLock lock(mutex_);
  robots_[robot].awaited = time;
  for (;;) {
    const bool has_ended = changed_.wait_for(lock, kRepeatPeriod, [&]() GSV_REQUIRES(mutex_) {
      const Robot& there = robots_[robot];
      return !there.is_open || there.stamp == time;
    });
    if (has_ended) break;
    lock.unlock();
    {
      const base::MutexLock repeat_lock(repeat_mutex_);
      if (repeat_) repeat_();
    }
    lock.lock();
  }
  const Robot& there = robots_[robot];
  return there.is_open ? std::optional(there.command) : std::nullopt;
}

void NodeSteps::SetRepeat(std::function<void()> repeat) {
  const base::MutexLock lock(repeat_mutex_);
  repeat_ = std::move(repeat);
}

NodeBehaviour::NodeBehaviour(std::shared_ptr<NodeSteps> steps, base::SimTime period)
    : steps_(std::move(steps)), period_(period) {}

NodeBehaviour::~NodeBehaviour() { (void)Stop(); }

base::Status NodeBehaviour::Init(const std::shared_ptr<simulation::Agent>& agent) {
  agent_ = agent;
  robot_ = agent->robot();
  steps_->Open(robot_, true);
  return {};
}

base::Status NodeBehaviour::Start() {
  const auto clock = agent_->OpenClock();
  if (!clock) return base::Fail(clock.error());
  steps_->Open(robot_, true);
  thread_ = std::thread([this, agent = agent_, id = *clock] { Run(*agent, id); });
  return {};
}

void NodeBehaviour::Run(simulation::Agent& agent, simulation::ClockId clock) {
  base::Result<simulation::Wait> wait = simulation::Wait::kReached;
  while (wait) {
    const base::SimTime now = agent.Now();
    const auto command = steps_->Await(robot_, now);
    if (!command) break;
    // If this fails, the wait below fails as well and returns the error.
    (void)agent.Command(*command);
    const base::SimTime next = (now / period_ + 1) * period_;
    do {
      wait = agent.SleepUntil(clock, next, kStepLease);
    } while (wait && *wait == simulation::Wait::kNotYet);
  }
  (void)agent.CloseClock(clock);
}

base::Status NodeBehaviour::Stop() {
  if (!robot_.empty()) steps_->Open(robot_, false);
  if (thread_.joinable()) thread_.join();
  return {};
}

void NodeBehaviour::Destroy() {
  (void)Stop();
  agent_.reset();
}

}  // namespace gsv::ros2
