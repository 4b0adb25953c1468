// A cache of readings of slow sensors. For example, an image of one instant is rendered only once
// for the behaviour, the recording and all viewers.
//
// Bounded      by the total size of the readings in bytes; the oldest readings are removed first.
//              Readings of destroyed snapshots are removed at the next reading.
// Threads      any. If a thread needs a reading that another thread is taking, it waits for this
//              reading.
// Determinism  a cached reading equals a new one: it depends only on the snapshot, the body, the
//              seed and the sensor's description, which are its key.
#pragma once

#include <cstddef>
#include <deque>
#include <future>
#include <memory>

#include "gsv/base/mutex.h"
#include "gsv/sensing/registry.h"
#include "gsv/sensing/sensor.h"

namespace gsv::sensing {

// Caches readings of slow sensors.
class SharedReadings {
 public:
  explicit SharedReadings(std::size_t capacity_bytes) : capacity_(capacity_bytes) {}

  // Returns sensor.Sample(sampling), cached. Errors are not cached.
  base::Result<Reading> Take(const Sensor& sensor, const Sampling& sampling);

  // The size of all cached readings.
  std::size_t bytes() const;

 private:
  // A reading that one thread takes, and for which others may wait.
  using Taken = std::shared_future<base::Result<Reading>>;
  // A cached reading. The other members are its key.
  struct Entry {
    std::weak_ptr<const world::Snapshot> snapshot;
    int body;  // index in the layout of the robot's body
    std::uint64_t seed;
    model::SensorDescription description;
    Taken taken;        // the reading, or an error
    std::size_t bytes;  // size of the reading; 0 until it is finished
  };

  // Whether the entry is the reading of this sensor at this sampling.
  bool IsOf(const Entry& entry, const Sensor& sensor, const Sampling& sampling) const;
  // Stores a finished reading and frees the oldest readings. If taking the reading failed, removes
  // its entry.
  void Account(const Sensor& sensor, const Sampling& sampling, const base::Result<Reading>& taken);

  const std::size_t capacity_;
  mutable base::Mutex mutex_;
  std::size_t bytes_ GSV_GUARDED_BY(mutex_) = 0;
  std::deque<Entry> entries_ GSV_GUARDED_BY(mutex_);  // the oldest first
};

// Makes all sensors of the type share their readings.
void Share(SensorType& type, std::shared_ptr<SharedReadings> readings);

}  // namespace gsv::sensing
