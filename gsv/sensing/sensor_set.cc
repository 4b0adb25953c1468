#include "gsv/sensing/sensor_set.h"

#include <algorithm>

#include "gsv/base/spelling.h"

namespace gsv::sensing {

base::Result<std::shared_ptr<const Sensor>> SensorSet::Of(
    const model::SensorDescription& description) {
  auto& known = known_[description.name];
  for (const std::weak_ptr<const Sensor>& each : known) {
    auto sensor = each.lock();
    if (sensor != nullptr && sensor->description() == description) return sensor;
  }
  const SensorType* const type = types_.Find(description.type);
  if (type == nullptr) {
    return base::Fail(base::ErrorCode::kNotFound,
                      "there is no sensor type \"" + description.type + "\"" +
                          base::DidYouMean(description.type, types_.names()),
                      description.name);
  }
  auto made = type->create(description);
  if (!made) return base::Fail(made.error());
  std::erase_if(known, [](const auto& each) { return each.expired(); });
  std::shared_ptr<const Sensor> sensor = *std::move(made);
  known.push_back(sensor);
  return sensor;
}

}  // namespace gsv::sensing
