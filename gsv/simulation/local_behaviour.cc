#include "gsv/simulation/local_behaviour.h"

namespace gsv::simulation {

base::Result<sensing::Reading> Turn::Read(MountedSensor& sensor) const {
  const SnapshotHistory::SnapshotPtr& snapshot = instant_->snapshots.At(sensor.design().period);
  auto reading = sensor.Read({snapshot, body_, instant_->seed, *instant_->rays});
  if (reading) sensor.CountReading();
  return reading;
}

}  // namespace gsv::simulation
