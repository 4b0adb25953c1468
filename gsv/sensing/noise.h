// The noise of sensors, by the parameters of SDFormat's <noise>.
//
// Parameters  under a prefix that the sensor documents, such as "noise" or
//             "angular_velocity.x.noise". SDFormat has no outliers and dropouts.
//   type                    "none" switches all noise off
//   mean, stddev            mean and standard deviation of the white noise
//   bias_mean, bias_stddev  mean and standard deviation of a bias that is drawn once per run
//   dynamic_bias_stddev (unit per root second), dynamic_bias_correlation_time (s)   of a drifting
//                           bias
//   precision               readings are rounded to multiples of this value
//   outlier_probability, outlier_stddev   some readings have additional noise
//   dropout_probability     some readings are lost
// Model       value + N(mean, stddev) + bias + drift, and + N(0, outlier_stddev) for an outlier,
//             rounded to the precision. A dropout reads NaN. The drift has the standard deviation
//             dynamic_bias_stddev * sqrt(correlation time / 2), to which Gazebo's drift converges.
// Determinism random numbers are keyed by (seed, robot, sensor, step) and the channel. So a number
//             does not depend on other values or on the order of readings.
#pragma once

#include <cstdint>
#include <string>

#include "gsv/sensing/parameters.h"
#include "gsv/sensing/sensor.h"

namespace gsv::sensing {

// The parameters of the noise of one quantity. All values except the probabilities and `drift_time`
// have the unit of the quantity.
struct NoiseModel {
  double mean = 0, stddev = 0;            // mean and standard deviation of the white noise
  double bias_mean = 0, bias_stddev = 0;  // the same for the bias, which is constant
  // standard deviation of the drift, and its correlation time in s (0: no drift)
  double drift_stddev = 0, drift_time = 0;
  double precision = 0;  // step to which readings are rounded; 0: not rounded
  // fraction of readings with additional noise; standard deviation of this noise
  double outlier_probability = 0, outlier_stddev = 0;
  double dropout_probability = 0;  // fraction of readings that are lost

  bool is_none() const { return *this == NoiseModel{}; }
  friend bool operator==(const NoiseModel&, const NoiseModel&) = default;
};

// Reads the parameters. `limit` is the maximum of all parameters that have the unit of the measured
// quantity.
NoiseModel ReadNoise(ParameterReader& reader, const std::string& prefix, double limit);

// The noise of one sensor at one instant.
class NoisyReading {
 public:
  NoisyReading(const Sampling& sampling, const model::SensorDescription& description);

  // Returns the reading for the true `value`. The noise of each channel of a sensor is independent.
  double Read(const NoiseModel& model, std::uint64_t channel, double value) const;
  // Returns the bias and the drift, without white noise.
  double Bias(const NoiseModel& model, std::uint64_t channel) const;
  // Whether the reading drops out at this instant.
  bool IsDropped(const NoiseModel& model, std::uint64_t channel) const;

 private:
  // Returns the number of the random stream of a channel for one purpose.
  std::uint64_t StreamOf(std::uint64_t channel, std::uint64_t purpose) const;

  const std::uint64_t seed_;    // seed of the simulation
  const std::uint64_t stream_;  // identifies the robot and the sensor
  const std::uint64_t step_;    // step of the sampled snapshot
  const base::SimTime time_;    // time of the sampled snapshot
};

}  // namespace gsv::sensing
