#include "gsv/simulation/robots/local_behaviour.h"

namespace gsv::simulation {

void Turn::Instant::Prepare(base::ThreadTeam& team) {
  scene = casts_rays ? rays->At(snapshots.latest(), &team) : nullptr;
  casts_rays = false;
}

sensing::Sampling Turn::Instant::MakeSampling() const {
  return {snapshots.latest(), -1, seed, *rays};
}

base::Result<sensing::Reading> Turn::Read(MountedSensor& sensor) const {
  if (sensor.casts_rays() && !instant_->casts_rays.load(std::memory_order_relaxed)) {
    instant_->casts_rays.store(true, std::memory_order_relaxed);
  }
  const SnapshotHistory::SnapshotPtr& snapshot = instant_->snapshots.At(sensor.design().cadence);
  auto reading = snapshot == sampling_->snapshot()
                     ? sensor.Read(*sampling_)
                     : sensor.Read({snapshot, sampling_->body(), instant_->seed, *instant_->rays});
  if (reading) sensor.CountReading();
  return reading;
}

base::Status Turn::CommandJoint(int joint, const world::JointCommand& command) {
  if (auto ok = world::CheckJointCommand(sampling_->robot(), joint, command); !ok) return ok;
  joint_commands_.emplace_back(joint, command);
  return {};
}

base::Status Turn::Send(const MountedSensor& radio, const std::string& receiver,
                        std::string content) {
  auto sending = MakeSending(radio, receiver, std::move(content), radio_, sampling_->robot().name);
  if (!sending) return base::Fail(sending.error());
  radio_.sendings.push_back(*std::move(sending));
  return {};
}

base::Status Turn::Act(const MountedSensor& actuator, world::ActuatorOrder order) {
  auto act = MakeAct(actuator, std::move(order), sampling_->robot().name);
  if (!act) return base::Fail(act.error());
  Add(*std::move(act), actuator_acts_);
  return {};
}

JointReading Turn::ReadJoint(int joint) const {
  return JointReadingIn(*sampling_->snapshot(), sampling_->body(), joint);
}

}  // namespace gsv::simulation
