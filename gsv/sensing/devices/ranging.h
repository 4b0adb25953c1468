// The sensor type "ranging": the distance to a radio anchor. It models tags of ultra-wideband (UWB)
// radio, which measure the distance by the time of flight.
//
// Model       true distance + noise + bias_per_metre x distance + wall_delay x walls. The white
//             noise has the variance noise.stddev^2 + (range_noise x distance)^2 + wall_noise^2 x
//             walls. A wall is a solid on the line of sight, as for radios (radio_link.h). The
//             distance is the distance at the sampled instant; the time of flight is ignored.
// Parameters  (with their default values)
//   anchor (required)       name of the model to which the distance is measured
//   min (0 m), max (50 m)   limits of the distance
//   noise (m)               see noise.h; its mean is a bias
//   range_noise (0 m per metre), bias_per_metre (0 m per metre)
//   wall_delay (0 m per wall), wall_noise (0 m per square root of the number of walls)
//   max_walls (8)           an anchor behind more walls is not received
// Readings    readings::Ranging. As a message: sensor_msgs/Range. The range is infinite if the
//             anchor is not received.
// Errors      an anchor that is not in the world is not received.
#pragma once

#include "gsv/sensing/registry.h"

namespace gsv::sensing {

SensorType RangingType();

}  // namespace gsv::sensing
