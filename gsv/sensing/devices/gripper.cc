#include "gsv/sensing/devices/gripper.h"

#include "gsv/messages/gsv_msgs.h"
#include "gsv/sensing/actuator.h"
#include "gsv/sensing/sensor_type.h"

namespace gsv::sensing {
namespace {

world::GripperSetup ReadGripper(ParameterReader& reader) {
  world::GripperSetup gripper;
  gripper.opening = reader.Number("opening", gripper.opening, 1e-3, 10);
  gripper.reach = reader.Number("reach", gripper.reach, 1e-3, 10);
  gripper.height = reader.Number("height", gripper.height, 1e-3, 10);
  gripper.closing_time = reader.Number("closing_time", gripper.closing_time, 1e-3, 1000);
  gripper.left_jaw = reader.Text("left_jaw", "");
  gripper.right_jaw = reader.Text("right_jaw", "");
  return gripper;
}

class Gripper final : public Actuator {
 public:
  Gripper(const model::SensorDescription& description, ParameterReader& reader)
      : Actuator(description, ReadGripper(reader)) {}

  base::Status Check(const world::ActuatorOrder& order) const override {
    if (auto ok = CheckShape(order, 1); !ok) return ok;
    if (order.values[0] == 0 || order.values[0] == 1) return {};
    return Refuse("a gripper is told 1, to open, or 0, to close");
  }

  base::Result<Reading> Sample(const Sampling& sampling) const override {
    const world::ActuatorState* const state = StateIn(sampling);
    Reading reading = sampling.Stamped();
    if (state == nullptr) {
      reading.values = {std::get<world::GripperSetup>(setup()->kind).opening, 1};
    } else {
      reading.values = {world::OpeningOf(*state, sampling.snapshot()->state.time),
                        world::IsToldToOpen(*state) ? 1.0 : 0.0};
    }
    reading.labels = std::make_shared<const std::vector<std::string>>(
        1, state != nullptr ? state->grip.held : std::string());
    return reading;
  }

  static messages::gsv_msgs::Gripper ToMessage(const model::SensorDescription& description,
                                               const Reading& reading, const std::string&) {
    messages::gsv_msgs::Gripper message;
    if (reading.values.size() != 2) return message;
    ParameterReader reader(description);
    const world::GripperSetup gripper = ReadGripper(reader);
    message.opening_m = reading.values[0];
    message.told_to_open = reading.values[1] != 0;
    message.held = reading.labels->front();
    message.reach_m = gripper.reach;
    message.height_m = gripper.height;
    return message;
  }
};

}  // namespace

SensorType GripperType() { return MakeSensorType<Gripper, messages::gsv_msgs::Gripper>("gripper"); }

}  // namespace gsv::sensing
