#include "gsv/sensing/ranges.h"

#include "gsv/readings/catalogue.h"

namespace gsv::sensing {

std::span<const double> RangesOf(const model::SensorDescription& sensor,
                                 const Reading::Values& values) {
  const bool has_intensities =
      sensor.type == readings::Lidar::kType &&
      model::NumberOr(sensor.parameters, readings::Lidar::kIntensityParameter, 0) > 0;
  const std::span<const double> all(values.data(), values.size());
  return has_intensities ? readings::Lidar{all, {}}.WithIntensities().ranges : all;
}

}  // namespace gsv::sensing
