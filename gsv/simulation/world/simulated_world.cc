#include "gsv/simulation/world/simulated_world.h"

#include <algorithm>
#include <span>
#include <utility>

#include "gsv/simulation/world/device_loop.h"
#include "gsv/world/accelerations.h"

namespace gsv::simulation {
namespace {

// The number of bodies that a thread processes at a time. This takes some microseconds.
constexpr std::size_t kBodiesAtOnce = 128;
constexpr std::size_t kVelocitiesAtOnce = 512;

// For fewer bodies, a second thread saves no time.
constexpr std::size_t kMinBodies = 400;
std::size_t BodiesAtOnce(std::size_t bodies) {
  return bodies < kMinBodies ? kMinBodies : kBodiesAtOnce;
}

template <class T>
std::span<T> Part(std::vector<T>& of, std::size_t begin, std::size_t end) {
  return std::span(of).subspan(begin, end - begin);
}

}  // namespace

SimulatedWorld::SimulatedWorld(std::unique_ptr<dynamics::Engine> engine,
                               std::shared_ptr<const world::Layout> layout,
                               std::shared_ptr<base::ThreadTeam> team)
    : engine_(std::move(engine)),
      layout_(std::move(layout)),
      state_(world::InitialState(*layout_)),
      team_(std::move(team)) {
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
  snapshot.joint_accelerations = state_.joint_velocities;
  snapshot.accelerations.resize(state_.bodies.size());
  team_->ParallelFor(state_.bodies.size(), kVelocitiesAtOnce,
                     [&](std::size_t begin, std::size_t end) GSV_REQUIRES(world_mutex) {
                       world::KeepBodyVelocities(Part(state_.bodies, begin, end),
                                                 Part(snapshot.accelerations, begin, end));
                     });
  wheel_odometry_.KeepWheels(state_);
  engine_->Step(step, state_, snapshot.contacts);
  MoveDevices(*layout_, state_.time + step, state_);
  snapshot.step_length = step;
  ++state_.step;
  state_.time = state_.step * step;
  snapshot.layout = layout_;
  FinishStep(base::ToSeconds(step), snapshot);
}

// Completes the step in one pass over the bodies, so that the state of each body is loaded into the
// cache only once.
void SimulatedWorld::FinishStep(double step_seconds, world::Snapshot& snapshot) {
  world::FinishContacts(state_, snapshot.accelerations, snapshot.contacts);
  world::FinishJointAccelerations(state_.joint_velocities, step_seconds,
                                  snapshot.joint_accelerations);
  // The bodies are moved out of both states, so that the assignment copies everything except the
  // bodies.
  std::vector<world::BodyState> bodies = std::move(state_.bodies);
  std::vector<world::BodyState> copies = std::move(snapshot.state.bodies);
  snapshot.state = state_;
  state_.bodies = std::move(bodies);
  copies.resize(state_.bodies.size());
  snapshot.state.bodies = std::move(copies);
  team_->ParallelFor(state_.bodies.size(), BodiesAtOnce(state_.bodies.size()),
                     [&](std::size_t begin, std::size_t end) GSV_REQUIRES(world_mutex) {
                       wheel_odometry_.Advance(step_seconds, begin, end, state_);
                       const auto moved = Part(state_.bodies, begin, end);
                       world::FinishBodyAccelerations(moved, step_seconds,
                                                      Part(snapshot.accelerations, begin, end));
                       std::copy(moved.begin(), moved.end(),
                                 Part(snapshot.state.bodies, begin, end).begin());
                     });
}

}  // namespace gsv::simulation
