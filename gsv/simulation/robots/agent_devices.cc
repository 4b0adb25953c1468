// The part of RobotAgent that opens, reads and commands joints, sensors and actuators.
#include <utility>

#include "gsv/simulation/robots/robot_agent.h"

namespace gsv::simulation {

base::Status RobotAgent::CommandJoint(int joint, const world::JointCommand& command) {
  const auto snapshot = shared_->history.latest();
  const int body = snapshot->layout->Find(robot_);
  if (body < 0) {
    return base::Fail(base::ErrorCode::kNotRunning, "the robot is not in the world yet", robot_);
  }
  const world::Body& robot = snapshot->layout->bodies[static_cast<std::size_t>(body)];
  if (auto ok = world::CheckJointCommand(robot, joint, command); !ok) return ok;
  AgentCallLock lock(*shared_);
  if (auto ok = CheckCanCommand(); !ok) return ok;
  Commands().CommandJoint(joint, command);
  return {};
}

base::Result<JointReading> RobotAgent::ReadJoint(int joint) {
  {
    AgentCallLock lock(*shared_);
    if (auto ok = CheckCanCommand(); !ok) return base::Fail(ok.error());
  }
  const auto snapshot = shared_->history.latest();
  const int body = snapshot->layout->Find(robot_);
  if (body < 0)
    return base::Fail(base::ErrorCode::kEnded, "the robot does not exist any more", robot_);
  if (joint < 0 || joint >= static_cast<int>(model_->joints.size())) {
    return base::Fail(base::ErrorCode::kNotFound,
                      "there is no joint number " + std::to_string(joint), robot_);
  }
  return JointReadingIn(*snapshot, body, joint);
}

base::Status RobotAgent::OpenSensor(const std::string& name) {
  AgentCallLock lock(*shared_);
  if (auto ok = CheckCanCommand(); !ok) return ok;
  if (auto ok = rack_.Open(name); !ok) return ok;
  SwitchOn(**rack_.Find(name));
  return {};
}

void RobotAgent::SwitchOn(const MountedSensor& sensor) {
  auto device = sensor.device();
  if (device == nullptr || !device->IsOnWhileOpen()) return;
  Commands().Add({DeviceAction::Kind::kSwitchOn, std::move(device)});
}

void RobotAgent::StartDevice(const MountedSensor& sensor) {
  auto device = sensor.device();
  auto command = device != nullptr ? device->first() : std::nullopt;
  if (!command) return;
  Commands().Add({DeviceAction::Kind::kCommand, std::move(device), *std::move(command)});
}

void RobotAgent::StartDevices() {
  for (const SensorDesignPtr& design : *shared_->designs.Of(model_)) {
    StartDevice(MountedSensor(design));
  }
}

base::Status RobotAgent::CreateSensor(model::SensorDescription description) {
  AgentCallLock lock(*shared_);
  if (auto ok = CheckCanCommand(); !ok) return ok;
  const std::string name = description.name;
  auto created = rack_.Create(std::move(description), static_cast<int>(model_->links.size()));
  if (!created) return created;
  const MountedSensorPtr sensor = *rack_.Find(name);
  shared_->history.Use(sensor->design().cadence);
  SwitchOn(*sensor);
  StartDevice(*sensor);
  return {};
}

base::Status RobotAgent::CloseSensor(const std::string& name) {
  AgentCallLock lock(*shared_);
  const auto sensor = rack_.Find(name);
  if (auto ok = rack_.Close(name); !ok) return ok;
  auto device = (*sensor)->device();
  // Closing an actuator of the model does not end the actuator's command.
  const bool ends = device != nullptr && (device->IsOnWhileOpen() || !rack_.Find(name));
  if (ends && CheckAlive()) {
    Commands().Add({DeviceAction::Kind::kSwitchOff, std::move(device)});
  }
  return {};
}

base::Status RobotAgent::CommandDevice(const std::string& actuator, world::DeviceCommand command) {
  const auto mounted = rack_.Find(actuator);
  if (!mounted) return base::Fail(mounted.error());
  auto action = CommandOf(**mounted, std::move(command), robot_);
  if (!action) return base::Fail(action.error());
  AgentCallLock lock(*shared_);
  if (auto ok = CheckCanCommand(); !ok) return ok;
  Commands().Add(*std::move(action));
  return {};
}

base::Status RobotAgent::Send(const std::string& radio, const std::string& receiver,
                              std::string content) {
  const auto mounted = rack_.Find(radio);
  if (!mounted) return base::Fail(mounted.error());
  AgentCallLock lock(*shared_);
  if (auto ok = CheckCanCommand(); !ok) return ok;
  return Commands().Send(**mounted, receiver, std::move(content), robot_);
}

base::Result<sensing::Reading> RobotAgent::Sample(MountedSensor& sensor) {
  const auto snapshot = shared_->history.At(sensor.design().cadence);
  const int body = snapshot->layout->Find(robot_);
  if (body < 0)
    return base::Fail(base::ErrorCode::kEnded, "the robot does not exist any more", robot_);
  return sensor.Watch({snapshot, body, shared_->seed, shared_->rays});
}

base::Result<sensing::Reading> RobotAgent::Read(const std::string& sensor) {
  {
    AgentCallLock lock(*shared_);
    if (auto ok = CheckCanCommand(); !ok) return base::Fail(ok.error());
  }
  const auto mounted = rack_.Find(sensor);
  if (!mounted) return base::Fail(mounted.error());
  auto reading = Sample(**mounted);
  if (reading) (*mounted)->CountReading();
  return reading;
}

base::Result<sensing::Reading> RobotAgent::Watch(const std::string& sensor) {
  const auto mounted = rack_.Find(sensor);
  if (!mounted) return base::Fail(mounted.error());
  return Sample(**mounted);
}

}  // namespace gsv::simulation
