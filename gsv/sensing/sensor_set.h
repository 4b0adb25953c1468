// Sensors by description. Equal descriptions, as of robots of one model, share one Sensor.
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

  // kNotFound for an unknown type; else the error of the type for invalid parameters.
  base::Result<std::shared_ptr<const Sensor>> Of(const model::SensorDescription& description);

 private:
  const SensorRegistry& types_;
  // By name, as few models use one name for different sensors. Expired ones are removed when
  // another one of their name is made.
  std::map<std::string, std::vector<std::weak_ptr<const Sensor>>, std::less<>> known_;
};

}  // namespace gsv::sensing
