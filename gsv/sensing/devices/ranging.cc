#include "gsv/sensing/devices/ranging.h"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "gsv/messages/sensor_msgs.h"
#include "gsv/sensing/noise.h"
#include "gsv/sensing/radio_link.h"
#include "gsv/sensing/sensor_type.h"

namespace gsv::sensing {
namespace {

class RangingSensor final : public SensorOf<readings::Ranging, messages::sensor_msgs::Range> {
 public:
  RangingSensor(const model::SensorDescription& description, ParameterReader& reader)
      : SensorOf(description),
        anchor_(reader.Text("anchor", "")),
        min_(reader.Number("min", 0, 0, 1e5)),
        max_(reader.Number("max", 50, 1e-3, 1e5)),
        noise_(ReadNoise(reader, "noise", 1e4)),
        range_noise_(reader.Number("range_noise", 0, 0, 10)),
        bias_per_metre_(reader.Number("bias_per_metre", 0, -1, 10)),
        wall_delay_(reader.Number("wall_delay", 0, 0, 100)),
        wall_noise_(reader.Number("wall_noise", 0, 0, 100)),
        max_walls_(reader.Count("max_walls", 8, 0, 1000)) {
    if (anchor_.empty())
      reader.Refuse("anchor is missing; set it to the name of the anchor's model");
    if (min_ > max_) reader.Refuse(fmt::format("min ({}) is larger than max ({})", min_, max_));
  }

  base::Result<Reading> Sample(const Sampling& sampling) const override {
    Reading reading = sampling.Stamped();
    Fill(readings::Ranging{Measured(sampling)}, reading);
    return reading;
  }
  bool CastsRays() const override { return true; }

 private:
  double Measured(const Sampling& sampling) const {
    constexpr double kNotHeard = std::numeric_limits<double>::infinity();
    const world::Snapshot& snapshot = *sampling.snapshot();
    const int body = snapshot.layout->Find(anchor_);
    if (body < 0) return kNotHeard;
    const Antenna from{nullptr, sampling.WorldFromSensor(description()).position, sampling.body()};
    const Antenna to{
        nullptr, snapshot.state.bodies.at(static_cast<std::size_t>(body)).world_from_model.position,
        body};
    const double distance = Norm(to.position - from.position);
    if (distance < min_ || distance > max_) return kNotHeard;
    const int walls = WallsBetween(sampling.Rays(), from, to);
    const NoisyReading noisy(sampling, description());
    if (walls > max_walls_ || noisy.IsDropped(noise_, 0)) return kNotHeard;
    NoiseModel noise = noise_;
    noise.stddev = std::sqrt(std::pow(noise.stddev, 2) + std::pow(range_noise_ * distance, 2) +
                             walls * wall_noise_ * wall_noise_);
    return std::max(0.0,
                    noisy.Read(noise, 0, distance * (1 + bias_per_metre_) + walls * wall_delay_));
  }

  Message ToMessage(const Values& ranging, const Reading&, const std::string&) const override {
    Message message;
    message.min_range = static_cast<float>(min_);
    message.max_range = static_cast<float>(max_);
    message.range = static_cast<float>(ranging.distance);
    return message;
  }

  const std::string anchor_;
  const double min_, max_;
  const NoiseModel noise_;
  const double range_noise_, bias_per_metre_, wall_delay_, wall_noise_;
  const int max_walls_;
};

}  // namespace

SensorType RangingType() { return MakeSensorType<RangingSensor>(readings::Ranging::kType); }

}  // namespace gsv::sensing
