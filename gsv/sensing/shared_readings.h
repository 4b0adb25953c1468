// The readings taken last by sensors that take long: what a camera saw at one instant is asked for
// by its robot's behaviour, by the recording and by each viewer, and drawn once.
//
// Bounded      by the bytes of what is kept; the oldest goes first. What was read from a snapshot
//              that is gone goes with the next reading.
// Threads      any; who asks for what another is just taking waits for him.
// Determinism  a reading is a function of what it is found by here.
#pragma once

#include <cstddef>
#include <deque>
#include <future>
#include <memory>

#include "gsv/base/mutex.h"
#include "gsv/sensing/registry.h"
#include "gsv/sensing/sensor.h"

namespace gsv::sensing {

class SharedReadings {
 public:
  explicit SharedReadings(std::size_t capacity_bytes) : capacity_(capacity_bytes) {}

  // What sensor.Sample(sampling) gives. Errors are not kept.
  base::Result<Reading> Take(const Sensor& sensor, const Sampling& sampling);

  std::size_t bytes() const;

 private:
  using Taken = std::shared_future<base::Result<Reading>>;
  struct Entry {
    std::weak_ptr<const world::Snapshot> snapshot;
    int body;
    std::uint64_t seed;
    model::SensorDescription description;
    Taken taken;
    std::size_t bytes;  // 0 while it is being taken
  };

  bool IsOf(const Entry& entry, const Sensor& sensor, const Sampling& sampling) const;
  void Account(const Sensor& sensor, const Sampling& sampling, const base::Result<Reading>& taken);

  const std::size_t capacity_;
  mutable base::Mutex mutex_;
  std::size_t bytes_ GSV_GUARDED_BY(mutex_) = 0;
  std::deque<Entry> entries_ GSV_GUARDED_BY(mutex_);  // the oldest first
};

// From here on all sensors of the type share their readings.
void Share(SensorType& type, std::shared_ptr<SharedReadings> readings);

}  // namespace gsv::sensing
