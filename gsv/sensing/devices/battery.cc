#include "gsv/sensing/devices/battery.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "gsv/messages/sensor_msgs.h"
#include "gsv/sensing/noise.h"
#include "gsv/sensing/sensor_type.h"

namespace gsv::sensing {
namespace {

constexpr double kSecondsAnHour = 3600;

class Battery final : public SensorOf<readings::Battery, messages::sensor_msgs::BatteryState> {
 public:
  Battery(const model::SensorDescription& description, ParameterReader& reader)
      : SensorOf(description),
        capacity_(reader.Number("capacity", 5, 1e-3, 1e6)),
        initial_(reader.Number("initial_charge", 1, 0, 1)),
        full_(reader.Number("voltage_full", 12.6, 0, 1e5)),
        empty_(reader.Number("voltage_empty", 10.5, 0, 1e5)),
        resistance_(reader.Number("resistance", 0.1, 0, 1e4)),
        idle_current_(reader.Number("idle_current", 0.5, 0, 1e5)),
        drive_charge_(reader.Number("drive_charge", 4, 0, 1e6)),
        voltage_noise_(ReadNoise(reader, "voltage.noise", 1e5)),
        current_noise_(ReadNoise(reader, "current.noise", 1e5)) {
    if (empty_ > full_) {
      reader.Refuse(
          fmt::format("voltage_empty ({}) is larger than voltage_full ({})", empty_, full_));
    }
  }

  base::Result<Reading> Sample(const Sampling& sampling) const override {
    const world::State& state = sampling.snapshot()->state;
    const world::BodyState& body = state.bodies[sampling.body()];
    const double drawn =
        idle_current_ * base::ToSeconds(state.time - body.since) + drive_charge_ * body.distance;
    const double charge = std::max(0.0, initial_ * capacity_ - drawn / kSecondsAnHour);
    const double fraction = charge / capacity_;
    const double current =
        charge > 0 ? idle_current_ + drive_charge_ * geometry::Norm(body.linear_velocity) : 0;
    const double voltage =
        charge > 0 ? std::max(0.0, empty_ + (full_ - empty_) * fraction - resistance_ * current)
                   : 0;
    const NoisyReading noisy(sampling, description());
    Reading reading = sampling.Stamped();
    Fill(Values{.voltage = noisy.Read(voltage_noise_, 0, voltage),
                .current = noisy.Read(current_noise_, 1, current),
                .charge = charge,
                .capacity = capacity_,
                .fraction = fraction},
         reading);
    return reading;
  }

 private:
  Message ToMessage(const Values& battery, const Reading&, const std::string&) const override {
    Message message;
    message.voltage = static_cast<float>(battery.voltage);
    message.current = static_cast<float>(-battery.current);
    message.charge = static_cast<float>(battery.charge);
    message.capacity = message.design_capacity = static_cast<float>(battery.capacity);
    message.percentage = static_cast<float>(battery.fraction);
    // the temperature is not measured
    message.temperature = std::numeric_limits<float>::quiet_NaN();
    message.power_supply_status = Message::kPowerSupplyStatusDischarging;
    message.present = true;
    return message;
  }

  const double capacity_, initial_, full_, empty_, resistance_, idle_current_, drive_charge_;
  const NoiseModel voltage_noise_, current_noise_;
};

}  // namespace

SensorType BatteryType() { return MakeSensorType<Battery>(readings::Battery::kType); }

}  // namespace gsv::sensing
