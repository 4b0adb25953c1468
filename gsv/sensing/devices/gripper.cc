#include "gsv/sensing/devices/gripper.h"

#include "gsv/messages/gsv_msgs.h"
#include "gsv/sensing/actuator.h"
#include "gsv/sensing/devices/gripper_state.h"
#include "gsv/sensing/sensor_type.h"

namespace gsv::sensing {
namespace {

GripperSetup ReadGripper(ParameterReader& reader) {
  GripperSetup gripper;
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
      : Actuator(description), setup_(std::make_shared<const GripperSetup>(ReadGripper(reader))) {}

  base::Status Check(const world::DeviceCommand& command) const override {
    if (auto ok = CheckShape(command, 1); !ok) return ok;
    if (command.values[0] == 0 || command.values[0] == 1) return {};
    return Refuse("a gripper is told 1, to open, or 0, to close");
  }

  base::Result<Reading> Sample(const Sampling& sampling) const override {
    const auto* const state = dynamic_cast<const GripperState*>(StateIn(sampling));
    Reading reading = sampling.Stamped();
    if (state == nullptr) {
      reading.values = {setup_->opening, 1};
    } else {
      reading.values = {state->OpeningAt(sampling.snapshot()->state.time),
                        state->opens() ? 1.0 : 0.0};
    }
    const world::Grasp* const grasp = state != nullptr ? state->grasp() : nullptr;
    reading.labels = std::make_shared<const std::vector<std::string>>(
        1, grasp != nullptr ? grasp->held : std::string());
    return reading;
  }

  static messages::gsv_msgs::Gripper ToMessage(const model::SensorDescription& description,
                                               const Reading& reading, const std::string&) {
    messages::gsv_msgs::Gripper message;
    if (reading.values.size() != 2) return message;
    ParameterReader reader(description);
    const GripperSetup gripper = ReadGripper(reader);
    message.opening_m = reading.values[0];
    message.told_to_open = reading.values[1] != 0;
    message.held = reading.labels->front();
    message.reach_m = gripper.reach;
    message.height_m = gripper.height;
    return message;
  }

 private:
  world::DeviceStatePtr Follow(world::DeviceMount mount, world::FollowedCommand followed,
                               const world::DeviceState* before) const override {
    return GripperState::After(before, std::move(mount), std::move(followed), setup_);
  }

  const GripperSetupPtr setup_;
};

}  // namespace

SensorType GripperType() { return MakeSensorType<Gripper, messages::gsv_msgs::Gripper>("gripper"); }

}  // namespace gsv::sensing
