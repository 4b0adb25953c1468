#include "gsv/hosting/local_joint.h"

#include "sdk/behaviour/finite.h"

namespace gsv::hosting {
namespace {

using Kind = world::JointCommand::Kind;

JointTraits TraitsOf(const model::Joint& joint) {
  return {joint.name,
          model::NameOf(joint.kind),
          joint.position_limits.min,
          joint.position_limits.max,
          joint.velocity_limit,
          joint.effort_limit};
}

class LocalJoint final : public Joint {
 public:
  LocalJoint(LocalRobot& robot, int joint, JointTraits traits)
      : robot_(robot), joint_(joint), traits_(std::move(traits)) {}

  const JointTraits& traits() const override { return traits_; }
  void MoveTo(double position) override {
    CheckJoint(position, "position", traits_.name);
    robot_.CommandJoint(joint_, {Kind::kPosition, position});
  }
  void MoveAt(double velocity) override {
    CheckJoint(velocity, "velocity", traits_.name);
    robot_.CommandJoint(joint_, {Kind::kVelocity, velocity});
  }
  void Apply(double effort) override {
    CheckJoint(effort, "effort", traits_.name);
    robot_.CommandJoint(joint_, {Kind::kEffort, effort});
  }
  void Release() override { robot_.CommandJoint(joint_, {}); }
  JointState Read() override {
    const auto reading = robot_.ReadJoint(joint_);
    return reading ? JointState{reading->time, reading->position, reading->velocity} : JointState();
  }

 private:
  LocalRobot& robot_;
  const int joint_;
  const JointTraits traits_;
};

}  // namespace

std::vector<JointTraits> TraitsOf(const std::vector<model::Joint>& joints) {
  std::vector<JointTraits> traits;
  for (const model::Joint& joint : joints) {
    if (model::TakesCommands(joint.kind)) traits.push_back(TraitsOf(joint));
  }
  return traits;
}

base::Result<std::unique_ptr<Joint>> MakeLocalJoint(LocalRobot& robot,
                                                    const std::vector<model::Joint>& joints,
                                                    const std::string& name) {
  const int joint = model::FindJoint(joints, name);
  if (joint < 0) {
    return base::Fail(base::ErrorCode::kNotFound,
                      "there is no joint \"" + name + "\" that accepts commands", robot.name());
  }
  return std::make_unique<LocalJoint>(robot, joint,
                                      TraitsOf(joints[static_cast<std::size_t>(joint)]));
}

}  // namespace gsv::hosting
