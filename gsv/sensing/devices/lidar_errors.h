// Errors of real lidars beside white noise. They depend on how far a surface is, how it is turned
// (from the ranges of the neighbouring beams), and where it ends.
//
// Parameters  all 0 by default, which changes nothing:
//             range_noise (m a metre): deviation that grows with range.
//             incidence_noise (m): deviation for each unit of the tangent of the angle of incidence.
//             beam_divergence (rad): a beam that wide that meets an edge measures something between
//             the two surfaces (mixed pixel), with the probability that it covers the edge.
//             reach (m): from how far a surface that is met squarely still gives an echo. One that is
//             turned gives as little from reach times the root of the cosine.
//             short_probability, short_range (m, 1): shares of beams that meet something which the
//             world does not show (dust, people), at exponentially distributed ranges.
// Source      for the shares: Thrun, Burgard and Fox, "Probabilistic Robotics", section 6.3. For the
//             cosine: Lambert's law and the equation of the lidar.
// Determinism keyed by (seed, robot, sensor, step) and the beam.
#pragma once

#include <span>

#include "gsv/sensing/parameters.h"
#include "gsv/sensing/sensor.h"

namespace gsv::sensing {

struct LidarErrors {
  double range_noise = 0, incidence_noise = 0;
  double beam_divergence = 0;
  double reach = 0;
  double short_probability = 0, short_range = 1;

  bool is_none() const {
    return range_noise == 0 && incidence_noise == 0 && beam_divergence == 0 && reach == 0 &&
           short_probability == 0;
  }
};

LidarErrors ReadLidarErrors(ParameterReader& reader);

// Changes the ranges of one row. `step` (rad) lies between beams; `first_beam` numbers them.
// Infinite ranges are beams without an echo.
void Disturb(const LidarErrors& errors, const Sampling& sampling,
             const model::SensorDescription& description, double step, std::size_t first_beam,
             std::span<double> ranges);

}  // namespace gsv::sensing
