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

// The sensors of one robot: those of its model, and those that a caller has created.
class SensorRack {
 public:
  // The rack begins with the sensors of the robot's model. `designs` must outlive the rack.
  SensorRack(std::string robot, const std::shared_ptr<const model::Model>& model,
             SensorDesigns& designs);

  // Returns the descriptions of all sensors, open or closed.
  std::vector<model::SensorDescription> Descriptions() const;
  // The sensor types that can be created.
  std::vector<std::string> TypeNames() const { return designs_.types().names(); }

  // Creates and opens a sensor. `link_count` is the number of links of the model.
  base::Status Create(model::SensorDescription description, int link_count);
  // Opens a sensor by its name.
  base::Status Open(const std::string& name);
  // Closes a sensor. A created sensor is removed; a sensor of the model can be opened again.
  base::Status Close(const std::string& name);
  // Closes all sensors, removes created sensors, and clears readings and counts.
  void Reset();

  // Returns a sensor, which may be closed. Fails if the name is unknown.
  base::Result<MountedSensorPtr> Find(const std::string& name) const;
  std::vector<MountedSensorPtr> OpenSensors() const;  // Returns the open sensors, ordered by name.

  // Returns the number of readings that the behaviour received, by sensor type.
  std::map<std::string, std::uint64_t> readings_by_type() const;

 private:
  // A sensor and its state on this robot.
  struct Slot {
    MountedSensorPtr sensor;
    bool is_created = false;  // whether a caller created the sensor; false if it belongs to the
                              // model
    bool is_open = false;
  };
  // Returns null if the name is unknown.
  const Slot* FindSlot(const std::string& name) const GSV_REQUIRES(mutex_);
  // The index of the slot with the name `name`. If there is none, the index at which this slot
  // would be inserted.
  std::size_t PlaceOf(const std::string& name) const GSV_REQUIRES(mutex_);
  // Returns the error for an unknown name.
  base::Error NoSuchSensor(const std::string& name) const;

  const std::string robot_;
  SensorDesigns& designs_;
  mutable base::Mutex mutex_;
  std::vector<Slot> slots_ GSV_GUARDED_BY(mutex_);  // ordered by name
  // Number of readings of created sensors that were closed and thus removed. The key is the sensor
  // type.
  std::map<std::string, std::uint64_t> closed_readings_ GSV_GUARDED_BY(mutex_);
};

}  // namespace gsv::simulation
