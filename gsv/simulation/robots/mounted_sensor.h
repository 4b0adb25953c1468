// A sensor on a robot: what is designed once for all robots of a model, and one robot's newest
// reading of it.
//
// Threads  any. Sampling one sensor never holds up another.
#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "gsv/base/mutex.h"
#include "gsv/sensing/registry.h"
#include "gsv/simulation/history/snapshot_history.h"

namespace gsv::simulation {

struct SensorDesign {
  model::SensorDescription description;
  std::unique_ptr<const sensing::Sensor> sensor;  // null: cannot be made, see `refusal`
  base::Error refusal;
  Cadence cadence;
};

using SensorDesignPtr = std::shared_ptr<const SensorDesign>;

// `where` is for the sentence of an error: "robot_3/front".
base::Result<SensorDesignPtr> MakeSensorDesign(model::SensorDescription description,
                                               const sensing::SensorRegistry& types,
                                               const std::string& where);

// The sensors of each model, designed when its first robot comes.
class SensorDesigns {
 public:
  explicit SensorDesigns(std::shared_ptr<const sensing::SensorRegistry> types)
      : types_(std::move(types)) {}

  using List = std::vector<SensorDesignPtr>;  // by name

  // A sensor of a type that is not registered, or whose parameters are refused, is in the list with
  // its refusal.
  std::shared_ptr<const List> Of(const std::shared_ptr<const model::Model>& model);
  const sensing::SensorRegistry& types() const { return *types_; }

 private:
  const std::shared_ptr<const sensing::SensorRegistry> types_;
  base::Mutex mutex_;
  // Looked up only.
  std::map<std::shared_ptr<const model::Model>, std::shared_ptr<const List>> known_
      GSV_GUARDED_BY(mutex_);
};

class MountedSensor {
 public:
  explicit MountedSensor(SensorDesignPtr design) : design_(std::move(design)) {}

  const SensorDesign& design() const { return *design_; }
  const std::string& name() const { return design_->description.name; }
  bool casts_rays() const { return design_->sensor != nullptr && design_->sensor->CastsRays(); }
  bool takes_long() const { return design_->sensor != nullptr && design_->sensor->TakesLong(); }

  // Null for a sensor that is no device.
  std::shared_ptr<const sensing::Device> device() const {
    const auto* const device = design_->sensor != nullptr ? design_->sensor->device() : nullptr;
    return device != nullptr ? std::shared_ptr<const sensing::Device>(design_, device) : nullptr;
  }

  // The sample of `sampling`'s instant: taken now if nobody has asked for it before.
  base::Result<sensing::Reading> Read(const sensing::Sampling& sampling);

  // A fault: from here on its newest sample stays that of `snapshot`, or, without one, who reads it
  // gets an error.
  void Fail(std::shared_ptr<const world::Snapshot> snapshot);

  // Readings that the behaviour was given.
  void CountReading() { readings_.fetch_add(1, std::memory_order_relaxed); }
  std::uint64_t readings() const { return readings_.load(std::memory_order_relaxed); }

  // Back to the start.
  void Forget();

 private:
  base::Result<sensing::Reading> SampleOnce(const sensing::Sampling& sampling) GSV_REQUIRES(mutex_);

  const SensorDesignPtr design_;
  std::atomic<std::uint64_t> readings_{0};

  base::Mutex mutex_;
  std::int64_t sampled_step_ GSV_GUARDED_BY(mutex_) = -1;  // -1: never
  std::uint32_t sampled_layout_ GSV_GUARDED_BY(mutex_) = 0;
  sensing::Reading newest_ GSV_GUARDED_BY(mutex_);
  bool has_failed_ GSV_GUARDED_BY(mutex_) = false;
  std::shared_ptr<const world::Snapshot> silent_since_ GSV_GUARDED_BY(mutex_);
};

}  // namespace gsv::simulation
