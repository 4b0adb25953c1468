#include "gsv/sensing/actuator.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace gsv::sensing {

base::Status Actuator::CheckShape(const world::DeviceCommand& command, std::size_t count) const {
  if (command.values.size() != count) {
    return Refuse(fmt::format("a {} is told {} numbers, not {}", description().type, count,
                              command.values.size()));
  }
  if (std::any_of(command.values.begin(), command.values.end(),
                  [](double value) { return !std::isfinite(value); })) {
    return Refuse("what an actuator is told must be finite");
  }
  return {};
}

base::Status Actuator::CheckRange(const char* what, double value, double low, double high) const {
  if (value >= low && value <= high) return {};
  return Refuse(fmt::format("the {} is {}; it must lie between {} and {}", what, value, low, high));
}

}  // namespace gsv::sensing
