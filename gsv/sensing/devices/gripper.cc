#include "gsv/sensing/devices/gripper.h"

#include <fmt/format.h>

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
  gripper.left_finger = reader.Text("left_jaw", "");
  gripper.right_finger = reader.Text("right_jaw", "");
  return gripper;
}

class Gripper final : public SensorOf<readings::Gripper, messages::gsv_msgs::Gripper, Actuator> {
 public:
  Gripper(const model::SensorDescription& description, ParameterReader& reader)
      : SensorOf(description), setup_(std::make_shared<const GripperSetup>(ReadGripper(reader))) {}

  base::Status Check(const world::DeviceCommand& command) const override {
    if (auto ok = CheckShape(command, 1); !ok) return ok;
    if (command.values[0] == 0 || command.values[0] == 1) return {};
    return Refuse(fmt::format("the gripper's command is {}; it must be 1 (open) or 0 (close)",
                              command.values[0]));
  }

  base::Result<Reading> Sample(const Sampling& sampling) const override {
    const auto* const state = dynamic_cast<const GripperState*>(StateIn(sampling));
    Values jaws{setup_->opening, true, ""};
    if (state != nullptr) {
      const world::Grasp* const grasp = state->grasp();
      jaws = {state->OpeningAt(sampling.snapshot()->state.time), state->opens(),
              grasp != nullptr ? grasp->held : std::string()};
    }
    Reading reading = sampling.Stamped();
    Fill(jaws, reading);
    return reading;
  }

 private:
  Message ToMessage(const Values& jaws, const Reading&, const std::string&) const override {
    Message message;
    message.opening_m = jaws.opening;
    message.told_to_open = jaws.told_to_open;
    message.held = jaws.held;
    message.reach_m = setup_->reach;
    message.height_m = setup_->height;
    return message;
  }

  world::DeviceStatePtr Follow(world::DeviceMount mount, world::FollowedCommand followed,
                               const world::DeviceState* before) const override {
    return GripperState::After(before, std::move(mount), std::move(followed), setup_);
  }

  const GripperSetupPtr setup_;
};

}  // namespace

SensorType GripperType() { return MakeSensorType<Gripper>(readings::Gripper::kType); }

}  // namespace gsv::sensing
