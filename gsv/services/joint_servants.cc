#include "gsv/services/joint_servants.h"

#include "gsv/orb/errors.h"

namespace gsv::services {
namespace {

using AgentPtr = std::shared_ptr<simulation::Agent>;
using Kind = world::JointCommand::Kind;

sba::JointTraits JointTraitsOf(const model::Joint& joint) {
  sba::JointTraits traits;
  traits.name = joint.name.c_str();
  traits.kind = model::NameOf(joint.kind);
  traits.min_position = joint.position_limits.min;
  traits.max_position = joint.position_limits.max;
  traits.max_velocity = joint.velocity_limit;
  traits.max_effort = joint.effort_limit;
  return traits;
}

class JointServant final : public POA_sba::JointActuator {
 public:
  JointServant(AgentPtr agent, int joint) : agent_(std::move(agent)), joint_(joint) {}

  sba::JointTraits* traits() override {
    return new sba::JointTraits(JointTraitsOf(agent_->Joints()[static_cast<std::size_t>(joint_)]));
  }
  void move_to(CORBA::Double position) override { Command({Kind::kPosition, position}); }
  void move_at(CORBA::Double velocity) override { Command({Kind::kVelocity, velocity}); }
  void apply(CORBA::Double effort) override { Command({Kind::kEffort, effort}); }
  void release() override { Command({}); }
  sba::JointReading read() override {
    const simulation::JointReading reading =
        orb::ValueOrThrow(agent_->ReadJoint(joint_), orb::kNotRunning | orb::kEnded | orb::kFailed);
    return {reading.position, reading.velocity, reading.time.count()};
  }

 private:
  void Command(const world::JointCommand& command) {
    orb::ValueOrThrow(agent_->CommandJoint(joint_, command));
  }

  const AgentPtr agent_;
  const int joint_;
};

}  // namespace

sba::JointTraitsList* ListJoints(const simulation::Agent& agent) {
  auto* list = new sba::JointTraitsList;
  for (const model::Joint& joint : agent.Joints()) {
    if (!model::TakesCommands(joint.kind)) continue;
    list->length(list->length() + 1);
    (*list)[list->length() - 1] = JointTraitsOf(joint);
  }
  return list;
}

sba::JointActuator_ptr ActivateJoint(AgentPtr agent, const std::string& name,
                                     const std::shared_ptr<ServantGroup>& group) {
  const int joint = model::FindJoint(agent->Joints(), name);
  if (joint < 0) {
    throw sba::Refused(("there is no joint \"" + name + "\" that accepts commands").c_str());
  }
  return group->Activate<sba::JointActuator>(new JointServant(std::move(agent), joint));
}

}  // namespace gsv::services
