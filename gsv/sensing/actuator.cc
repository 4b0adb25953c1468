#include "gsv/sensing/actuator.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace gsv::sensing {

base::Status Actuator::CheckShape(const world::DeviceCommand& command, std::size_t count) const {
  if (command.values.size() != count) {
    return Refuse(fmt::format("a {} command has {} numbers, not {}", description().type, count,
                              command.values.size()));
  }
  if (std::any_of(command.values.begin(), command.values.end(),
                  [](double value) { return !std::isfinite(value); })) {
    return Refuse("the numbers of a command must be finite");
  }
  return {};
}

base::Status Actuator::CheckRange(const char* what, double value, double low, double high) const {
  if (value >= low && value <= high) return {};
  return Refuse(fmt::format("the {} is {}; it must lie between {} and {}", what, value, low, high));
}

}  // namespace gsv::sensing
