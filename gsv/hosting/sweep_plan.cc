#include "gsv/hosting/sweep_plan.h"

#include <utility>

#include "gsv/base/mutex.h"

namespace gsv::hosting {
namespace {

bool AreEqual(const SweepPlan& a, const SweepPlan& b) {
  return a.names == b.names && a.beam_of == b.beam_of && a.beams.IsIdenticalTo(b.beams);
}

// The plans in use.
class KnownPlans {
 public:
  std::shared_ptr<const SweepPlan> FindOrAdd(std::shared_ptr<const SweepPlan> plan) {
    const base::MutexLock lock(mutex_);
    std::erase_if(plans_, [](const auto& known) { return known.expired(); });
    for (const std::weak_ptr<const SweepPlan>& each : plans_) {
      auto known = each.lock();
      if (known != nullptr && AreEqual(*known, *plan)) return known;
    }
    plans_.push_back(plan);
    return plan;
  }

 private:
  base::Mutex mutex_;
  std::vector<std::weak_ptr<const SweepPlan>> plans_ GSV_GUARDED_BY(mutex_);
};

}  // namespace

SweepPlan::SweepPlan(const std::vector<std::shared_ptr<simulation::MountedSensor>>& sensors) {
  for (const auto& sensor : sensors) {
    const simulation::SensorDesign& design = sensor->design();
    names.push_back(sensor->name());
    const bool is_beam = design.sensor != nullptr && design.sensor->beam() != nullptr &&
                         design.cadence == simulation::Cadence{};
    beam_of.push_back(is_beam ? beams.size() : kNoBeam);
    if (is_beam) beams.Add(*design.sensor);
  }
}

std::shared_ptr<const SweepPlan> Share(std::shared_ptr<const SweepPlan> plan) {
  static KnownPlans known;
  return known.FindOrAdd(std::move(plan));
}

}  // namespace gsv::hosting
