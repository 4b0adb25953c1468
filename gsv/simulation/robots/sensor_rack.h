// The sensors of one robot.
//
// Threads  any.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "gsv/base/mutex.h"
#include "gsv/simulation/robots/mounted_sensor.h"

namespace gsv::simulation {

using MountedSensorPtr = std::shared_ptr<MountedSensor>;

class SensorRack {
 public:
  // Starts with the sensors of the robot's model. `designs` must outlive the rack.
  SensorRack(std::string robot, const std::shared_ptr<const model::Model>& model,
             SensorDesigns& designs);

  std::vector<model::SensorDescription> Descriptions() const;
  // The types of which sensors can be created.
  std::vector<std::string> TypeNames() const { return designs_.types().names(); }

  // Creates and opens a sensor. `link_count` is the number of links of the model.
  base::Status Create(model::SensorDescription description, int link_count);
  base::Status Open(const std::string& name);
  // Closes a sensor. Removes it if it was created; a sensor of the model can be opened again.
  base::Status Close(const std::string& name);
  // Closes all sensors, removes created ones, and clears readings and counts.
  void Reset();

  // Returns a sensor, which may be closed. Fails if the name is unknown.
  base::Result<MountedSensorPtr> Find(const std::string& name) const;
  std::vector<MountedSensorPtr> OpenSensors() const;  // Returns the open sensors, ordered by name.

  std::map<std::string, std::uint64_t> readings_by_type() const;

 private:
  struct Slot {
    MountedSensorPtr sensor;
    bool is_created = false;  // whether a caller created it, and it does not belong to the model
    bool is_open = false;
  };
  // Returns null if the name is unknown.
  const Slot* FindSlot(const std::string& name) const GSV_REQUIRES(mutex_);
  // The index of the first slot whose name is not less than `name`.
  std::size_t PlaceOf(const std::string& name) const GSV_REQUIRES(mutex_);
  base::Error NoSuchSensor(const std::string& name) const;

  const std::string robot_;
  SensorDesigns& designs_;
  mutable base::Mutex mutex_;
  std::vector<Slot> slots_ GSV_GUARDED_BY(mutex_);  // ordered by name
  // Readings of closed sensors, by type.
  std::map<std::string, std::uint64_t> closed_readings_ GSV_GUARDED_BY(mutex_);
};

}  // namespace gsv::simulation
