#include "gsv/sensing/noise.h"

#include <cmath>
#include <limits>

#include "gsv/sensing/drift.h"

namespace gsv::sensing {
namespace {

enum Purpose : std::uint64_t { kWhite, kConstantBias, kDrift, kDropout, kPurposes };

}  // namespace

NoiseModel ReadNoise(ParameterReader& reader, const std::string& prefix, double limit) {
  NoiseModel model;
  const auto number = [&](const char* name, double low, double high) {
    return reader.Number(prefix + "." + name, 0, low, high);
  };
  model.mean = number("mean", -limit, limit);
  model.stddev = number("stddev", 0, limit);
  model.bias_mean = number("bias_mean", -limit, limit);
  model.bias_stddev = number("bias_stddev", 0, limit);
  const double drift = number("dynamic_bias_stddev", 0, limit);
  model.drift_time = number("dynamic_bias_correlation_time", 0, 1e9);
  model.drift_stddev = drift * std::sqrt(model.drift_time / 2);
  model.precision = number("precision", 0, limit);
  model.outlier_probability = number("outlier_probability", 0, 1);
  model.outlier_stddev = number("outlier_stddev", 0, limit);
  model.dropout_probability = number("dropout_probability", 0, 1);
  return reader.Text(prefix + ".type", "gaussian") == "none" ? NoiseModel{} : model;
}

NoisyReading::NoisyReading(const Sampling& sampling, const model::SensorDescription& description)
    : seed_(sampling.seed()),
      stream_(base::StableId(sampling.robot().name + "/" + description.name)),
      step_(static_cast<std::uint64_t>(sampling.snapshot()->state.step)),
      time_(sampling.snapshot()->state.time) {}

std::uint64_t NoisyReading::StreamOf(std::uint64_t channel, std::uint64_t purpose) const {
  // `stream_` is a hash, so its values are spread over all numbers. The numbers of channels are
  // consecutive, so Fibonacci hashing spreads them, too. Otherwise, streams could coincide.
  return stream_ ^ ((channel * kPurposes + purpose + 1) * 0x9E3779B97F4A7C15u);
}

double NoisyReading::Bias(const NoiseModel& model, std::uint64_t channel) const {
  double bias = model.bias_mean;
  if (model.bias_stddev > 0) {
    bias += model.bias_stddev * base::Noise(seed_, StreamOf(channel, kConstantBias), 0).Gaussian();
  }
  if (model.drift_stddev > 0) {
    bias += model.drift_stddev * DriftAt(time_, model.drift_time, seed_, StreamOf(channel, kDrift));
  }
  return bias;
}

bool NoisyReading::IsDropped(const NoiseModel& model, std::uint64_t channel) const {
  return model.dropout_probability > 0 &&
         base::Noise(seed_, StreamOf(channel, kDropout), step_).Uniform() <
             model.dropout_probability;
}

double NoisyReading::Read(const NoiseModel& model, std::uint64_t channel, double value) const {
  if (model.is_none()) return value;
  if (IsDropped(model, channel)) return std::numeric_limits<double>::quiet_NaN();
  base::Noise noise(seed_, StreamOf(channel, kWhite), step_);
  // All random numbers are drawn, even if some are not used. So one parameter does not affect the
  // random numbers of another parameter.
  const double white = noise.Gaussian(), strike = noise.Uniform(), stray = noise.Gaussian();
  value += model.mean + model.stddev * white + Bias(model, channel);
  if (strike < model.outlier_probability) value += model.outlier_stddev * stray;
  return model.precision > 0 ? model.precision * std::round(value / model.precision) : value;
}

}  // namespace gsv::sensing
