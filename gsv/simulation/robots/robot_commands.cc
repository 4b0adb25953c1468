#include "gsv/simulation/robots/robot_commands.h"

#include <algorithm>

namespace gsv::simulation {
namespace {

using Kind = DeviceAction::Kind;

constexpr std::ptrdiff_t kMaxMessagesPerStep = 64;

bool IsMessage(const DeviceAction& action) {
  return action.kind == Kind::kCommand && action.device->SendsMessages();
}

base::Failure<base::Error> RefuseCommand(const MountedSensor& sensor, const std::string& robot,
                                         std::string sentence) {
  return base::Fail(base::ErrorCode::kInvalidArgument, std::move(sentence),
                    robot + "/" + sensor.name());
}

}  // namespace

bool TakesCommands(const MountedSensor& sensor) {
  const auto device = sensor.device();
  return device != nullptr && !device->SendsMessages();
}

base::Result<DeviceAction> CommandOf(const MountedSensor& sensor, world::DeviceCommand command,
                                     const std::string& robot) {
  if (!TakesCommands(sensor)) {
    return RefuseCommand(sensor, robot, "a sensor accepts no commands");
  }
  auto device = sensor.device();
  if (auto ok = device->Check(command); !ok) {
    return RefuseCommand(sensor, robot, ok.error().message);
  }
  return DeviceAction{Kind::kCommand, std::move(device), std::move(command)};
}

void RobotCommands::OfferDrive(const Drive& drive) {
  if (!drive_ || drive.clock >= drive_->clock) drive_ = drive;
}

void RobotCommands::CommandJoint(int joint, const world::JointCommand& command) {
  joints_.emplace_back(joint, command);
}

void RobotCommands::ForgetJoint(int joint) {
  std::erase_if(joints_, [joint](const auto& command) { return command.first == joint; });
}

void RobotCommands::Add(DeviceAction action) {
  const auto is_same = [&](const DeviceAction& earlier) {
    return earlier.name() == action.name() && !IsMessage(earlier);
  };
  if (action.kind == Kind::kSwitchOff) {
    std::erase_if(devices_, is_same);
  } else if (!IsMessage(action)) {
    const auto last = std::find_if(devices_.rbegin(), devices_.rend(), is_same);
    if (last != devices_.rend() && last->kind == action.kind) {
      *last = std::move(action);
      return;
    }
  }
  devices_.push_back(std::move(action));
}

base::Status RobotCommands::Send(const MountedSensor& radio, const std::string& receiver,
                                 std::string content, const std::string& robot) {
  auto device = radio.device();
  if (device == nullptr || !device->SendsMessages()) {
    return RefuseCommand(radio, robot, "cannot send a message: only a radio can");
  }
  world::DeviceCommand message{{}, receiver, std::move(content)};
  if (auto ok = device->Check(message); !ok) {
    return RefuseCommand(radio, robot, ok.error().message);
  }
  if (std::count_if(devices_.begin(), devices_.end(), IsMessage) >= kMaxMessagesPerStep) {
    return RefuseCommand(radio, robot,
                         "a robot sends at most 64 messages in one step; send this one later");
  }
  Add({Kind::kCommand, std::move(device), std::move(message)});
  return {};
}

void RobotCommands::Merge(RobotCommands&& later) {
  if (later.drive_) drive_ = later.drive_;
  joints_.insert(joints_.end(), later.joints_.begin(), later.joints_.end());
  for (DeviceAction& action : later.devices_) Add(std::move(action));
  later.Clear();
}

}  // namespace gsv::simulation
