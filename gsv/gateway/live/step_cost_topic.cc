#include "gsv/gateway/live/step_cost_topic.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gsv/base/mutex.h"
#include "gsv/base/sorting.h"
#include "gsv/gateway/foxglove/channels.h"
#include "gsv/messages/time.h"

namespace gsv::gateway {
namespace {

using messages::gsv_msgs::HoldUp;
using messages::gsv_msgs::StepCost;
using messages::gsv_msgs::StepCosts;
using simulation::StepTimes;

constexpr double kStepCostRate = 2;  // rate of messages, Hz of wall-clock time
constexpr std::size_t kMaxKnownHoldUps = 4096;

double SecondsOf(std::chrono::nanoseconds duration) {
  return std::chrono::duration<double>(duration).count();
}

StepCost CostOf(const StepTimes& times) {
  StepCost cost;
  cost.step = static_cast<std::uint64_t>(times.step);
  cost.held_up_by = times.held_up_by;
  cost.behaviours_s = SecondsOf(times.behaviours);
  cost.devices_s = SecondsOf(times.devices);
  cost.bodies_s = SecondsOf(times.bodies);
  cost.observers_s = SecondsOf(times.observers);
  cost.idle_s = SecondsOf(times.idle);
  return cost;
}

// Returns the duration of the step without the time that it waited until it was due.
std::chrono::nanoseconds BusyTime(const StepTimes& times) { return times.total() - times.idle; }

bool IsLonger(const StepTimes& a, const StepTimes& b) { return BusyTime(a) > BusyTime(b); }

void Add(const StepTimes& times, StepTimes& sum) {
  sum.step = times.step;
  sum.time = times.time;
  sum.behaviours += times.behaviours;
  sum.devices += times.devices;
  sum.bodies += times.bodies;
  sum.observers += times.observers;
  sum.idle += times.idle;
}

}  // namespace

class StepCostTopic::Watch final : public simulation::Observer {
 public:
  void OnSnapshot(const std::shared_ptr<const world::Snapshot>&) override {}
  void OnEvent(const simulation::Event&) override {}
  bool wants_times() const override { return true; }

  void OnTimes(const StepTimes& times) override {
    const base::MutexLock lock(mutex_);
    ++collected_.steps;
    Add(times, collected_.sum);
    AddHoldUp(times);
    // The heap has its shortest step at the front.
    std::vector<StepTimes>& longest = collected_.longest;
    if (longest.size() == kMaxLongestSteps) {
      if (!IsLonger(times, longest.front())) return;
      std::pop_heap(longest.begin(), longest.end(), IsLonger);
      longest.pop_back();
    }
    longest.push_back(times);
    std::push_heap(longest.begin(), longest.end(), IsLonger);
  }

  // Returns the costs since the last call; nullopt if there were no steps.
  std::optional<StepCosts> Take() {
    Collected collected;
    {
      const base::MutexLock lock(mutex_);
      if (collected_.steps == 0) return {};
      collected = std::exchange(collected_, {});
    }
    return MessageOf(std::move(collected));
  }

 private:
  struct Collected {
    std::uint64_t steps = 0;
    StepTimes sum;
    std::map<std::string, HoldUp> hold_ups;  // by robot
    std::vector<StepTimes> longest;          // a heap of the longest steps
  };

  void AddHoldUp(const StepTimes& times) GSV_REQUIRES(mutex_) {
    if (times.held_up_by.empty()) return;
    auto& hold_ups = collected_.hold_ups;
    if (hold_ups.size() >= kMaxKnownHoldUps && !hold_ups.contains(times.held_up_by)) return;
    HoldUp& hold_up = hold_ups[times.held_up_by];
    const double waited = SecondsOf(times.behaviours);
    ++hold_up.steps;
    hold_up.total_s += waited;
    hold_up.longest_s = std::max(hold_up.longest_s, waited);
  }

  static StepCosts MessageOf(Collected collected) {
    StepCosts message;
    message.stamp = messages::ToMessage(collected.sum.time);
    message.steps = collected.steps;
    message.sum = CostOf(collected.sum);
    for (auto& [robot, hold_up] : collected.hold_ups) {
      hold_up.robot = robot;
      message.hold_ups.push_back(std::move(hold_up));
    }
    base::Sort(message.hold_ups,
               [](const HoldUp& a, const HoldUp& b) { return a.total_s > b.total_s; });
    if (message.hold_ups.size() > kMaxHoldUps) message.hold_ups.resize(kMaxHoldUps);
    base::Sort(collected.longest,
               [](const StepTimes& a, const StepTimes& b) { return a.step < b.step; });
    for (const StepTimes& times : collected.longest) message.longest.push_back(CostOf(times));
    return message;
  }

  base::Mutex mutex_;
  Collected collected_ GSV_GUARDED_BY(mutex_);
};

StepCostTopic::StepCostTopic(std::shared_ptr<Hub> hub)
    : hub_(std::move(hub)),
      channel_(hub_->Advertise({ChannelFor(presentation::topics::kStepCosts)}).front()),
      pacing_(kStepCostRate) {}

void StepCostTopic::Publish(simulation::Simulation& simulation, WallTime now) {
  if (!hub_->IsSubscribed(channel_)) {
    if (watch_) simulation.RemoveObserver(std::exchange(watch_, nullptr));
    return;
  }
  if (!watch_) {
    watch_ = std::make_shared<Watch>();
    simulation.AddObserver(watch_);
  }
  if (hub_->HasNewSubscribers(channel_)) hub_->Welcome(channel_, {});
  if (!pacing_.IsDue(now)) return;
  pacing_.Done(now);
  if (const auto costs = watch_->Take()) {
    const base::SimTime time = messages::ToSimTime(costs->stamp);
    hub_->Publish(channel_, {base::NanosecondsOf(time), Encoded(*costs)});
  }
}

}  // namespace gsv::gateway
