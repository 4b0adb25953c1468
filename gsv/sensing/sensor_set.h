// Creates sensors from their descriptions. Equal descriptions share one Sensor. For example, two
// robots of one model have equal descriptions.
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

  // Fails with kNotFound for an unknown type, and with the type's error for invalid parameters.
  base::Result<std::shared_ptr<const Sensor>> Of(const model::SensorDescription& description);

 private:
  const SensorRegistry& types_;
  // The sensors by name. Each list is short, because few models use one name for different sensors.
  // An expired sensor is removed when another sensor with the same name is created.
  std::map<std::string, std::vector<std::weak_ptr<const Sensor>>, std::less<>> known_;
};

}  // namespace gsv::sensing
