// A sensor on a robot: its design, which all robots of a model share, and its newest reading on
// this robot.
//
// Threads  any. Sampling a sensor does not block other sensors.
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

// A sensor of a model, which all robots of the model share.
struct SensorDesign {
  model::SensorDescription description;
  // null if the parameters are invalid; then `refusal` contains the reason
  std::unique_ptr<const sensing::Sensor> sensor;
  base::Error refusal;  // why the sensor could not be created
  Cadence cadence;      // when samples are taken and available
};

using SensorDesignPtr = std::shared_ptr<const SensorDesign>;

// Error messages name the sensor as `where`, such as "robot_3/front".
base::Result<SensorDesignPtr> MakeSensorDesign(model::SensorDescription description,
                                               const sensing::SensorRegistry& types,
                                               const std::string& where);

// The sensor designs of each model. They are made when the first robot of the model is added.
class SensorDesigns {
 public:
  explicit SensorDesigns(std::shared_ptr<const sensing::SensorRegistry> types)
      : types_(std::move(types)) {}

  using List = std::vector<SensorDesignPtr>;  // ordered by name

  // Returns the designs of a model. For a sensor of an unknown type or with invalid parameters, the
  // list has an entry with the error.
  std::shared_ptr<const List> Of(const std::shared_ptr<const model::Model>& model);
  const sensing::SensorRegistry& types() const { return *types_; }

  // Counts a sensor that was created on a robot, or removed from it.
  void CountChange() { changes_.fetch_add(1); }
  std::uint64_t changes() const { return changes_; }  // number of counted sensors

 private:
  const std::shared_ptr<const sensing::SensorRegistry> types_;
  std::atomic<std::uint64_t> changes_{0};
  base::Mutex mutex_;
  // Never iterated, because the order of pointers differs between runs.
  std::map<std::shared_ptr<const model::Model>, std::shared_ptr<const List>> known_
      GSV_GUARDED_BY(mutex_);
};

// Counts the sweeps of a robot. In a sweep, the behaviour reads several sensors of its robot
// together. This one count replaces a count of readings for each of these sensors.
struct Sweeps {
  // The number of sweeps. Only the thread that executes the behaviour's turn writes it.
  std::atomic<std::uint64_t> count{0};
  // Becomes false when a fault is applied to one of the sensors, or when Watch() or Forget() is
  // called for one of them. From then on, sensors are read one by one.
  std::atomic<bool> is_allowed{true};
};

// One sensor of one robot, with its newest reading.
class MountedSensor {
 public:
  explicit MountedSensor(SensorDesignPtr design) : design_(std::move(design)) {}

  const SensorDesign& design() const { return *design_; }
  const std::string& name() const { return design_->description.name; }
  bool casts_rays() const { return design_->sensor != nullptr && design_->sensor->CastsRays(); }
  bool takes_long() const { return design_->sensor != nullptr && design_->sensor->TakesLong(); }

  // Returns the sensor as a device (an actuator or radio), or null if it is not a device.
  std::shared_ptr<const sensing::Device> device() const {
    const auto* const device = design_->sensor != nullptr ? design_->sensor->device() : nullptr;
    return device != nullptr ? std::shared_ptr<const sensing::Device>(design_, device) : nullptr;
  }

  // Returns the sample at the instant of `sampling`. Takes the sample if it does not exist yet.
  base::Result<sensing::Reading> Read(const sensing::Sampling& sampling);
  // Like Read(), but for a caller that is not a turn of the robot's behaviour, such as a live
  // topic.
  base::Result<sensing::Reading> Watch(const sensing::Sampling& sampling);

  // From now on, each sweep that `sweeps` counts is also a reading of this sensor.
  void Join(std::shared_ptr<Sweeps> sweeps);

  // Applies a fault. From now on, the sensor reads the state in `snapshot`. If `snapshot` is null,
  // readings fail.
  void Fail(std::shared_ptr<const world::Snapshot> snapshot);

  // Counts a reading that the behaviour received.
  void CountReading() { readings_.fetch_add(1, std::memory_order_relaxed); }
  std::uint64_t readings() const;  // number of readings that the behaviour received

  // Resets the sensor to its initial state.
  void Forget();

 private:
  // Returns the reading of this step. Takes the sample if it does not exist yet.
  base::Result<sensing::Reading> SampleOnce(const sensing::Sampling& sampling) GSV_REQUIRES(mutex_);
  // From now on, the behaviour must read the sensors of the sweep one by one.
  void ForbidSweeps() GSV_REQUIRES(mutex_);

  const SensorDesignPtr design_;
  std::atomic<std::uint64_t> readings_{0};

  mutable base::Mutex mutex_;
  std::shared_ptr<Sweeps> sweeps_ GSV_GUARDED_BY(mutex_);  // null if the sensor belongs to no sweep
  // Sweeps::count when Join() was called. Later sweeps are readings of this sensor.
  std::uint64_t sweeps_before_ GSV_GUARDED_BY(mutex_) = 0;
  std::int64_t sampled_step_ GSV_GUARDED_BY(mutex_) = -1;    // step of the newest sample, or -1
  std::uint32_t sampled_layout_ GSV_GUARDED_BY(mutex_) = 0;  // Layout::version of the newest sample
  sensing::Reading newest_ GSV_GUARDED_BY(mutex_);           // the newest sample
  bool has_failed_ GSV_GUARDED_BY(mutex_) = false;           // whether a fault makes readings fail
  // The snapshot that the sensor keeps reading because of a fault; null if there is none.
  std::shared_ptr<const world::Snapshot> silent_since_ GSV_GUARDED_BY(mutex_);
};

}  // namespace gsv::simulation
