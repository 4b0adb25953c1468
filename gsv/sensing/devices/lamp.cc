#include "gsv/sensing/devices/lamp.h"

#include <cmath>
#include <numbers>

#include "gsv/messages/gsv_msgs.h"
#include "gsv/sensing/actuator.h"
#include "gsv/sensing/sensor_type.h"

namespace gsv::sensing {
namespace {

world::LampSetup ReadLamp(ParameterReader& reader) {
  world::LampSetup lamp;
  const geometry::Vector3 colour = reader.Triple("colour", {1, 1, 1}, 0, 1);
  lamp.colour = {colour.x, colour.y, colour.z, 1};
  lamp.radius = reader.Number("radius", lamp.radius, 1e-4, 10);
  lamp.range = reader.Number("range", lamp.range, 0, 1000);
  lamp.angle = reader.Number("angle", lamp.angle, 0.01, 2.001 * std::numbers::pi);
  lamp.intensity = reader.Number("intensity", lamp.intensity, 0, 1000);
  return lamp;
}

class Lamp final : public Actuator {
 public:
  Lamp(const model::SensorDescription& description, ParameterReader& reader)
      : Lamp(description, reader, ReadLamp(reader)) {}

  std::optional<world::ActuatorOrder> first() const override {
    if (brightness_ == 0) return std::nullopt;
    return OrderOf({brightness_, lamp_.colour});
  }

  base::Status Check(const world::ActuatorOrder& order) const override {
    if (auto ok = CheckShape(order, 4); !ok) return ok;
    if (auto ok = CheckRange("brightness", order.values[0], 0, 1); !ok) return ok;
    for (std::size_t i = 1; i < 4; ++i) {
      if (auto ok = CheckRange("colour's part", order.values[i], 0, 1); !ok) return ok;
    }
    return {};
  }

  base::Result<Reading> Sample(const Sampling& sampling) const override {
    const world::ActuatorState* const state = StateIn(sampling);
    const world::ActuatorOrder now =
        state != nullptr ? state->order : OrderOf({brightness_, lamp_.colour});
    Reading reading = sampling.Stamped();
    reading.values.assign(now.values.begin(), now.values.end());
    return reading;
  }

  static messages::gsv_msgs::Lamp ToMessage(const model::SensorDescription& description,
                                            const Reading& reading, const std::string&) {
    messages::gsv_msgs::Lamp message;
    if (reading.values.size() != 4) return message;
    ParameterReader reader(description);
    const world::LampSetup lamp = ReadLamp(reader);
    const auto part = [&](std::size_t i) { return static_cast<float>(reading.values[i]); };
    message.brightness = reading.values[0];
    message.color.r = part(1), message.color.g = part(2), message.color.b = part(3);
    message.color.a = 1;
    message.radius_m = lamp.radius;
    message.range_m = lamp.range;
    message.angle_rad = lamp.angle;
    message.intensity = lamp.intensity;
    return message;
  }

 private:
  Lamp(const model::SensorDescription& description, ParameterReader& reader,
       const world::LampSetup& lamp)
      : Actuator(description, lamp),
        lamp_(lamp),
        brightness_(reader.Number("brightness", 0, 0, 1)) {}

  static world::ActuatorOrder OrderOf(const world::Glow& glow) {
    return {{glow.brightness, glow.colour.r, glow.colour.g, glow.colour.b}, {}};
  }

  const world::LampSetup lamp_;
  const double brightness_;  // at the start
};

}  // namespace

SensorType LampType() { return MakeSensorType<Lamp, messages::gsv_msgs::Lamp>("lamp", {"led"}); }

}  // namespace gsv::sensing
