#include "gsv/simulation/world/simulated_world.h"

#include <utility>

#include "gsv/simulation/world/device_loop.h"

namespace gsv::simulation {

SimulatedWorld::SimulatedWorld(std::unique_ptr<dynamics::Engine> engine,
                               std::shared_ptr<const world::Layout> layout)
    : engine_(std::move(engine)),
      layout_(std::move(layout)),
      state_(world::InitialState(*layout_)) {
  wheel_odometry_.SetLayout(*layout_);
}

base::Status SimulatedWorld::Replace(std::shared_ptr<const world::Layout> layout,
                                     world::State state) {
  layout_ = std::move(layout);
  state_ = std::move(state);
  wheel_odometry_.SetLayout(*layout_);
  return TryLayout(layout_, state_);
}

void SimulatedWorld::Reset() {
  state_ = world::InitialState(*layout_);
  FollowAttachments();
}

void SimulatedWorld::Step(base::SimTime step, world::Snapshot& snapshot) {
  const double step_seconds = base::ToSeconds(step);
  world::KeepVelocities(state_, snapshot.accelerations, snapshot.joint_accelerations);
  wheel_odometry_.KeepWheels(state_);
  engine_->Step(step, state_, snapshot.contacts);
  MoveDevices(*layout_, state_.time + step, state_);
  wheel_odometry_.Advance(step_seconds, state_);
  world::FinishContacts(state_, snapshot.accelerations, snapshot.contacts);
  world::FinishAccelerations(state_, step_seconds, snapshot.accelerations,
                             snapshot.joint_accelerations);
  snapshot.step_length = step;
  ++state_.step;
  state_.time = state_.step * step;
  snapshot.layout = layout_;
  snapshot.state = state_;
}

}  // namespace gsv::simulation
