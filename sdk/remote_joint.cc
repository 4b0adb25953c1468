#include "sdk/remote_joint.h"

#include "gsv/orb/orb.h"
#include "sdk/behaviour/finite.h"

namespace gsv::sdk {
namespace {

JointTraits FromIdl(const sba::JointTraits& traits) {
  return {std::string(traits.name), std::string(traits.kind), traits.min_position,
          traits.max_position,      traits.max_velocity,      traits.max_effort};
}

sba::JointedHardware_var Jointed(sba::Hardware_ptr hardware) {
  const sba::JointedHardware_var jointed = sba::JointedHardware::_narrow(hardware);
  if (CORBA::is_nil(jointed))
    throw sba::Refused("this hardware has no joints that accept commands");
  return jointed;
}

class RemoteJoint final : public Joint {
 public:
  RemoteJoint(RemoteRobot& robot, sba::JointActuator_ptr joint, JointTraits traits)
      : robot_(robot), joint_(sba::JointActuator::_duplicate(joint)), traits_(std::move(traits)) {
    orb::LimitCalls(joint_, RemoteRobot::kCallTimeout);
  }

  const JointTraits& traits() const override { return traits_; }
  void MoveTo(double position) override {
    CheckJoint(position, "position", traits_.name);
    robot_.Try([&] { joint_->move_to(position); });
  }
  void MoveAt(double velocity) override {
    CheckJoint(velocity, "velocity", traits_.name);
    robot_.Try([&] { joint_->move_at(velocity); });
  }
  void Apply(double effort) override {
    CheckJoint(effort, "effort", traits_.name);
    robot_.Try([&] { joint_->apply(effort); });
  }
  void Release() override {
    robot_.Try([&] { joint_->release(); });
  }
  JointState Read() override {
    JointState state;
    robot_.Try([&] {
      const sba::JointReading reading = joint_->read();
      state = {SimTime(reading.time_ns), reading.position, reading.velocity};
    });
    return state;
  }

 private:
  RemoteRobot& robot_;
  sba::JointActuator_var joint_;
  const JointTraits traits_;
};

}  // namespace

std::vector<JointTraits> ListRemoteJoints(sba::Hardware_ptr hardware) {
  std::vector<JointTraits> traits;
  const sba::JointTraitsList_var list = Jointed(hardware)->list_joints();
  for (CORBA::ULong i = 0; i < list->length(); ++i) traits.push_back(FromIdl(list.in()[i]));
  return traits;
}

std::unique_ptr<Joint> OpenRemoteJoint(RemoteRobot& robot, sba::Hardware_ptr hardware,
                                       const std::string& name) {
  const sba::JointActuator_var joint = Jointed(hardware)->open_joint(name.c_str());
  const sba::JointTraits_var traits = joint->traits();
  return std::make_unique<RemoteJoint>(robot, joint, FromIdl(traits.in()));
}

}  // namespace gsv::sdk
