#include "gsv/sensing/shared_readings.h"

#include <algorithm>
#include <utility>

#include "gsv/sensing/forwarding_sensor.h"

namespace gsv::sensing {
namespace {

std::size_t BytesOf(const Reading& reading) {
  return sizeof(Reading) + reading.values.size() * sizeof(double) +
         (reading.image != nullptr ? reading.image->pixels.size() : 0);
}

// Compares the parts of two descriptions on which a reading depends.
bool SameSensor(const model::SensorDescription& a, const model::SensorDescription& b) {
  return a.name == b.name && a.type == b.type && a.link == b.link &&
         a.link_from_sensor == b.link_from_sensor && a.parameters == b.parameters;
}

class SharedSensor final : public ForwardingSensor {
 public:
  SharedSensor(std::unique_ptr<Sensor> sensor, std::shared_ptr<SharedReadings> readings)
      : ForwardingSensor(std::move(sensor)), readings_(std::move(readings)) {}

  base::Result<Reading> Sample(const Sampling& sampling) const override {
    return readings_->Take(sensor(), sampling);
  }

 private:
  const std::shared_ptr<SharedReadings> readings_;
};

}  // namespace

bool SharedReadings::IsOf(const Entry& entry, const Sensor& sensor,
                          const Sampling& sampling) const {
  // Compares the owners of the snapshots, because a new snapshot may have the address of an old
  // one.
  return entry.body == sampling.body() && entry.seed == sampling.seed() &&
         !entry.snapshot.owner_before(sampling.snapshot()) &&
         !sampling.snapshot().owner_before(entry.snapshot) &&
         SameSensor(entry.description, sensor.description());
}

base::Result<Reading> SharedReadings::Take(const Sensor& sensor, const Sampling& sampling) {
  std::promise<base::Result<Reading>> promise;
  {
    base::MutexLock lock(mutex_);
    const auto found = std::find_if(entries_.rbegin(), entries_.rend(), [&](const Entry& entry) {
      return IsOf(entry, sensor, sampling);
    });
    if (found != entries_.rend()) {
      const Taken taken = found->taken;
      lock.unlock();
      return taken.get();
    }
    entries_.push_back({sampling.snapshot(), sampling.body(), sampling.seed(), sensor.description(),
                        promise.get_future().share(), 0});
  }
  base::Result<Reading> taken = sensor.Sample(sampling);
  Account(sensor, sampling, taken);
  promise.set_value(taken);
  return taken;
}

void SharedReadings::Account(const Sensor& sensor, const Sampling& sampling,
                             const base::Result<Reading>& taken) {
  const base::MutexLock lock(mutex_);
  std::erase_if(entries_, [&](Entry& entry) GSV_REQUIRES(mutex_) {
    if (entry.bytes == 0) {  // the reading is not finished yet
      if (!IsOf(entry, sensor, sampling)) return false;
      if (!taken) return true;
      bytes_ += entry.bytes = BytesOf(*taken);
    }
    if (!entry.snapshot.expired()) return false;
    bytes_ -= entry.bytes;
    return true;
  });
  while (bytes_ > capacity_) {
    const auto oldest = std::find_if(entries_.begin(), entries_.end(),
                                     [](const Entry& entry) { return entry.bytes > 0; });
    bytes_ -= oldest->bytes;
    entries_.erase(oldest);
  }
}

std::size_t SharedReadings::bytes() const {
  const base::MutexLock lock(mutex_);
  return bytes_;
}

void Share(SensorType& type, std::shared_ptr<SharedReadings> readings) {
  type.create =
      [create = std::move(type.create), readings = std::move(readings)](
          const model::SensorDescription& description) -> base::Result<std::unique_ptr<Sensor>> {
    auto sensor = create(description);
    if (!sensor) return sensor;
    return std::make_unique<SharedSensor>(*std::move(sensor), readings);
  };
}

}  // namespace gsv::sensing
