#include "gsv/sensing/devices/lamp.h"

#include <cmath>
#include <numbers>

#include "gsv/messages/gsv_msgs.h"
#include "gsv/sensing/actuator.h"
#include "gsv/sensing/sensor_type.h"

namespace gsv::sensing {
namespace {

// Returns the lamp that the parameters describe, switched off. Its colour is the one at the start.
world::Glow ReadLamp(ParameterReader& reader) {
  world::Glow lamp;
  const geometry::Vector3 colour = reader.Triple("colour", {1, 1, 1}, 0, 1);
  lamp.colour = {colour.x, colour.y, colour.z, 1};
  lamp.radius = reader.Number("radius", lamp.radius, 1e-4, 10);
  lamp.range = reader.Number("range", lamp.range, 0, 1000);
  lamp.angle = reader.Number("angle", lamp.angle, 0.01, 2.001 * std::numbers::pi);
  lamp.intensity = reader.Number("intensity", lamp.intensity, 0, 1000);
  return lamp;
}

class LampState final : public world::ActuatorState {
 public:
  LampState(world::DeviceMount mount, world::FollowedCommand followed, const world::Glow& lamp)
      : ActuatorState(std::move(mount), std::move(followed)), lamp_(lamp) {}

  std::optional<world::Glow> glow() const override {
    const std::vector<double>& v = values();
    if (v.size() != 4 || v[0] <= 0) return std::nullopt;
    world::Glow glow = lamp_;
    glow.brightness = v[0];
    glow.colour = {v[1], v[2], v[3], 1};
    return glow;
  }

 private:
  const world::Glow lamp_;
};

class Lamp final : public SensorOf<readings::Lamp, messages::gsv_msgs::Lamp, Actuator> {
 public:
  Lamp(const model::SensorDescription& description, ParameterReader& reader)
      : SensorOf(description),
        lamp_(ReadLamp(reader)),
        brightness_(reader.Number("brightness", 0, 0, 1)) {}

  std::optional<world::DeviceCommand> first() const override {
    if (brightness_ == 0) return std::nullopt;
    return AtTheStart();
  }

  base::Status Check(const world::DeviceCommand& command) const override {
    if (auto ok = CheckShape(command, 4); !ok) return ok;
    if (auto ok = CheckRange("brightness", command.values[0], 0, 1); !ok) return ok;
    for (std::size_t i = 1; i < 4; ++i) {
      if (auto ok = CheckRange("colour's part", command.values[i], 0, 1); !ok) return ok;
    }
    return {};
  }

  base::Result<Reading> Sample(const Sampling& sampling) const override {
    const world::DeviceState* const state = StateIn(sampling);
    const world::DeviceCommand now = state != nullptr ? state->followed()->command : AtTheStart();
    Reading reading = sampling.Stamped();
    reading.values.assign(now.values.begin(), now.values.end());
    return reading;
  }

 private:
  Message ToMessage(const Values& glow, const Reading&, const std::string&) const override {
    Message message;
    message.brightness = glow.brightness;
    message.color.r = static_cast<float>(glow.colour.red);
    message.color.g = static_cast<float>(glow.colour.green);
    message.color.b = static_cast<float>(glow.colour.blue);
    message.color.a = 1;
    message.radius_m = lamp_.radius;
    message.range_m = lamp_.range;
    message.angle_rad = lamp_.angle;
    message.intensity = lamp_.intensity;
    return message;
  }

  world::DeviceStatePtr Follow(world::DeviceMount mount, world::FollowedCommand followed,
                               const world::DeviceState*) const override {
    return std::make_shared<const LampState>(std::move(mount), std::move(followed), lamp_);
  }

  world::DeviceCommand AtTheStart() const {
    return {{brightness_, lamp_.colour.r, lamp_.colour.g, lamp_.colour.b}, {}};
  }

  const world::Glow lamp_;
  const double brightness_;  // the brightness at the start
};

}  // namespace

SensorType LampType() { return MakeSensorType<Lamp>(readings::Lamp::kType, {"led"}); }

}  // namespace gsv::sensing
