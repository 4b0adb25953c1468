// Sensors by their descriptions: equal ones, as robots of one model have, are one Sensor.
//
// Threads  one.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "gsv/sensing/registry.h"

namespace gsv::sensing {

class SensorSet {
 public:
  // `types` outlives this.
  explicit SensorSet(const SensorRegistry& types) : types_(types) {}

  // kNotFound for an unknown type; what its type refuses is the type's error.
  base::Result<std::shared_ptr<const Sensor>> Of(const model::SensorDescription& description);

 private:
  const SensorRegistry& types_;
  // By name: few models give one name to different sensors. Those that nobody has any more go when
  // another one of their name is made.
  std::map<std::string, std::vector<std::weak_ptr<const Sensor>>, std::less<>> known_;
};

}  // namespace gsv::sensing
