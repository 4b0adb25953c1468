// Creates sensors from their descriptions. Equal descriptions, for example of two robots of one
// model, share one Sensor.
//
// Threads  one thread at a time.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "gsv/sensing/registry.h"

namespace gsv::sensing {

// Creates sensors, and shares one Sensor between equal descriptions.
class SensorSet {
 public:
  // `types` must outlive this object.
  explicit SensorSet(const SensorRegistry& types) : types_(types) {}

  // Returns kNotFound for an unknown type, and the type's error for invalid parameters.
  base::Result<std::shared_ptr<const Sensor>> Of(const model::SensorDescription& description);

 private:
  const SensorRegistry& types_;
  // The sensors by name, because few models use one name for different sensors. Expired sensors are
  // removed when another sensor with their name is made.
  std::map<std::string, std::vector<std::weak_ptr<const Sensor>>, std::less<>> known_;
};

}  // namespace gsv::sensing
