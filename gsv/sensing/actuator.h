// An actuator: a sensor that can be told something, and whose readings say what it does. Opened,
// created, recorded and shown as sensors are.
//
// Time  What it is told at an instant acts from then on, as a robot's other commands do.
#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "gsv/sensing/sensor.h"

namespace gsv::sensing {

class Actuator : public Sensor {
 public:
  const Actuator* actuator() const final { return this; }

  const world::ActuatorSetupPtr& setup() const { return setup_; }
  // What it does from the start, untold.
  virtual std::optional<world::ActuatorOrder> first() const { return std::nullopt; }
  // Refuses what it cannot do with a sentence.
  virtual base::Status Check(const world::ActuatorOrder& order) const = 0;

 protected:
  using Kind = decltype(world::ActuatorSetup::kind);

  Actuator(const model::SensorDescription& description, Kind kind)
      : Sensor(description),
        setup_(std::make_shared<const world::ActuatorSetup>(world::ActuatorSetup{
            description.link, description.link_from_sensor, std::move(kind)})) {}

  // Null as long as it was told nothing.
  const world::ActuatorState* StateIn(const Sampling& sampling) const {
    return world::FindActuator(sampling.snapshot()->state.actuators.get(), sampling.robot().name,
                               description().name);
  }
  base::Status Refuse(std::string sentence) const {
    return base::Fail(base::ErrorCode::kInvalidArgument, std::move(sentence), description().name);
  }
  // Refuses other than `count` values, and those that are not finite.
  base::Status CheckShape(const world::ActuatorOrder& order, std::size_t count) const;
  // Refuses a value outside of [low, high].
  base::Status CheckRange(const char* what, double value, double low, double high) const;

 private:
  const world::ActuatorSetupPtr setup_;
};

}  // namespace gsv::sensing
