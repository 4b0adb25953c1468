// The ranges of a reading.
#pragma once

#include <span>

#include "gsv/model/sensor_description.h"
#include "gsv/sensing/reading.h"

namespace gsv::sensing {

// Returns the ranges in a reading, without the intensities that may follow those of a lidar. Values
// of sensors of other types are returned unchanged. The result refers to `values`.
std::span<const double> RangesOf(const model::SensorDescription& sensor,
                                 const Reading::Values& values);

}  // namespace gsv::sensing
