// The noise of sensors, by the parameters of SDFormat's <noise>.
//
// Parameters  under the prefix that the sensor documents ("noise", "angular_velocity.x.noise"):
//             type ("none" turns all off), mean and stddev of white noise, bias_mean and
//             bias_stddev of a bias that is drawn once, dynamic_bias_stddev (in units per root
//             second) and dynamic_bias_correlation_time (s) of a drifting bias, precision (the
//             step of the output). GSV adds outlier_probability, outlier_stddev and
//             dropout_probability.
// Model       value + N(mean, stddev) + bias + drift, sometimes + N(0, outlier_stddev), rounded to
//             the nearest multiple of the precision; or a dropout (NaN). The drift has the standard
//             deviation dynamic_bias_stddev sqrt(correlation time / 2), to which that of Gazebo
//             converges.
// Determinism random numbers are keyed by (seed, robot, sensor, step) and the channel.
//             So a number does not depend on other values,
//             and it does not depend on the order of readings.
#pragma once

#include <cstdint>
#include <string>

#include "gsv/sensing/parameters.h"
#include "gsv/sensing/sensor.h"

namespace gsv::sensing {

struct NoiseModel {
  double mean = 0, stddev = 0;
  double bias_mean = 0, bias_stddev = 0;
  double drift_stddev = 0, drift_time = 0;  // drift_time 0: there is no drift
  double precision = 0;                     // 0: exact
  double outlier_probability = 0, outlier_stddev = 0;
  double dropout_probability = 0;

  bool is_none() const { return *this == NoiseModel{}; }
  friend bool operator==(const NoiseModel&, const NoiseModel&) = default;
};

// Reads the parameters. `limit` is the limit of those in the unit of the quantity.
NoiseModel ReadNoise(ParameterReader& reader, const std::string& prefix, double limit);

// The noise of one sensor at one instant.
class NoisyReading {
 public:
  NoisyReading(const Sampling& sampling, const model::SensorDescription& description);

  // Returns the reading for the true `value`. The channels of a sensor are independent.
  double Read(const NoiseModel& model, std::uint64_t channel, double value) const;
  // Returns the bias and the drift, without white noise.
  double Bias(const NoiseModel& model, std::uint64_t channel) const;
  bool IsDropped(const NoiseModel& model, std::uint64_t channel) const;

 private:
  std::uint64_t StreamOf(std::uint64_t channel, std::uint64_t purpose) const;

  const std::uint64_t seed_;
  const std::uint64_t stream_;
  const std::uint64_t step_;
  const base::SimTime time_;
};

}  // namespace gsv::sensing
