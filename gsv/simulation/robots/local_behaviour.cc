#include "gsv/simulation/robots/local_behaviour.h"

namespace gsv::simulation {

void Turn::Instant::Prepare(base::ThreadTeam& team) {
  scene = casts_rays ? rays->At(snapshots.latest(), &team) : nullptr;
  casts_rays = false;
}

sensing::Sampling Turn::Instant::MakeSampling() const {
  sensing::Sampling sampling(snapshots.latest(), -1, seed, *rays);
  if (scene != nullptr) (void)sampling.Rays();  // finds `scene` now, so that turns need not do it
  return sampling;
}

void Turn::Instant::NoteRays() const {
  // The flag is read before it is written, because needless writes would slow down other threads.
  if (casts_rays.load(std::memory_order_relaxed)) return;
  casts_rays.store(true, std::memory_order_relaxed);
}

void Turn::ReadBeams(const sensing::BeamSet& beams, std::span<double> values) const {
  instant_->NoteRays();
  beams.Sample(*sampling_, values);
}

base::Result<sensing::Reading> Turn::Read(MountedSensor& sensor) const {
  if (sensor.casts_rays()) instant_->NoteRays();
  const SnapshotHistory::SnapshotPtr& snapshot = instant_->snapshots.At(sensor.design().cadence);
  auto reading = snapshot == sampling_->snapshot()
                     ? sensor.Read(*sampling_)
                     : sensor.Read({snapshot, sampling_->body(), instant_->seed, *instant_->rays});
  if (reading) sensor.CountReading();
  return reading;
}

base::Status Turn::CommandJoint(int joint, const world::JointCommand& command) {
  if (auto ok = world::CheckJointCommand(sampling_->robot(), joint, command); !ok) return ok;
  commands_.CommandJoint(joint, command);
  return {};
}

base::Status Turn::Send(const MountedSensor& radio, const std::string& receiver,
                        std::string content) {
  return commands_.Send(radio, receiver, std::move(content), sampling_->robot().name);
}

base::Status Turn::CommandDevice(const MountedSensor& actuator, world::DeviceCommand command) {
  auto action = CommandOf(actuator, std::move(command), sampling_->robot().name);
  if (!action) return base::Fail(action.error());
  commands_.Add(*std::move(action));
  return {};
}

JointReading Turn::ReadJoint(int joint) const {
  return JointReadingIn(*sampling_->snapshot(), sampling_->body(), joint);
}

}  // namespace gsv::simulation
