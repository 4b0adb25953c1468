// Errors of real lidars besides white noise. They depend on the distance of a surface, on its angle
// (from the ranges of the adjacent beams), and on its edges.
//
// Parameters  (default 0, which means no error; short_range has its own default)
//   range_noise (m per metre)   standard deviation that grows with the range
//   incidence_noise (m)     standard deviation per unit of the tangent of the angle of incidence
//   beam_divergence (rad)   width of a beam. A beam that covers an edge measures a range between
//                           the two surfaces (mixed pixel).
//   reach (m)               maximum range of an echo from a surface at right angles to the beam. At
//                           the angle of incidence a, the maximum range is reach × sqrt(cos a).
//   short_probability       fraction of beams that hit objects which are not in the world, such as
//                           dust or people
//   short_range (1 m)       mean range of these hits, which is exponentially distributed
//
// Source      short_probability and short_range: Thrun, Burgard and Fox, "Probabilistic Robotics",
//             section 6.3. sqrt(cos a) in the maximum range: Lambert's law and the lidar equation.
// Determinism random numbers are keyed by (seed, robot, sensor, step) and the beam.
#pragma once

#include <span>

#include "gsv/sensing/parameters.h"
#include "gsv/sensing/sensor.h"

namespace gsv::sensing {

// The error parameters of a lidar.
struct LidarErrors {
  double range_noise = 0, incidence_noise = 0;    // m per metre; m
  double beam_divergence = 0;                     // rad
  double reach = 0;                               // m
  double short_probability = 0, short_range = 1;  // fraction of beams; m

  // Whether all errors are off.
  bool is_none() const {
    return range_noise == 0 && incidence_noise == 0 && beam_divergence == 0 && reach == 0 &&
           short_probability == 0;
  }
};

// Reads the parameters. Reports invalid ones to the reader.
LidarErrors ReadLidarErrors(ParameterReader& reader);

// Adds errors to the ranges of one row. `step` (rad) is the angle between adjacent beams.
// `first_beam` is the index of the row's first beam in the scan. A beam without an echo has an
// infinite range.
void Disturb(const LidarErrors& errors, const Sampling& sampling,
             const model::SensorDescription& description, double step, std::size_t first_beam,
             std::span<double> ranges);

}  // namespace gsv::sensing
