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

// Completes the steps of the bodies that the engine moves by several steps, as FinishStep() does
// for single steps.
class StepFinisher final : public dynamics::MotionFollower {
 public:
  StepFinisher(double step_seconds, const world::Layout& layout, world::WheelOdometry& odometry,
               world::State& state, world::Snapshot& snapshot, sensing::SceneDraft* scene)
      : step_seconds_(step_seconds),
        layout_(layout),
        odometry_(odometry),
        state_(state),
        snapshot_(snapshot),
        scene_(scene) {}

  void OnMoved(int body, int steps, int steps_left, bool may_touch) override {
    odometry_.AdvanceBody(step_seconds_, body, steps, state_);
    // Keeps the velocities from before the last step: the last acceleration is computed from them.
    // If `steps` is above 1, the velocity was constant, so the present velocities are kept.
    if (steps_left == 1 || (steps_left == 0 && steps > 1)) KeepVelocities(body);
    if (steps_left == 0 && may_touch) {
      may_touch_.push_back(body);  // OnContacts() needs its velocities from before the step
    } else if (steps_left == 0) {
      Finish(body);
    }
  }

  // Completes the bodies that OnMoved() does not complete.
  void OnContacts() override {
    for (std::size_t i = 0; i < layout_.bodies.size(); ++i) {
      if (layout_.bodies[i].is_planar()) continue;
      KeepVelocities(static_cast<int>(i));
      may_touch_.push_back(static_cast<int>(i));
    }
    world::FinishContacts(state_, snapshot_.accelerations, snapshot_.contacts);
    for (const int body : may_touch_) Finish(body);
  }

 private:
  void KeepVelocities(int body) {
    const auto i = static_cast<std::size_t>(body);
    world::KeepBodyVelocities(Part(state_.bodies, i, i + 1),
                              Part(snapshot_.accelerations, i, i + 1));
    const auto first = static_cast<std::ptrdiff_t>(layout_.bodies[i].first_joint);
    const auto joints = static_cast<std::ptrdiff_t>(layout_.bodies[i].model->joints.size());
    std::copy_n(state_.joint_velocities.begin() + first, joints,
                snapshot_.joint_accelerations.begin() + first);
  }
  void Finish(int body) {
    const auto i = static_cast<std::size_t>(body);
    world::FinishBodyAccelerations(Part(state_.bodies, i, i + 1), step_seconds_,
                                   Part(snapshot_.accelerations, i, i + 1));
    snapshot_.state.bodies[i] = state_.bodies[i];
    if (scene_ != nullptr) scene_->Place(body, state_.bodies[i].world_from_model);
  }

  const double step_seconds_;
  const world::Layout& layout_;
  world::WheelOdometry& odometry_;
  world::State& state_;
  world::Snapshot& snapshot_;
  sensing::SceneDraft* const scene_;  // null if no ray scene is made
  std::vector<int> may_touch_;        // bodies that OnContacts() must complete
};

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

bool SimulatedWorld::StepMany(base::SimTime step, int steps, world::Snapshot& snapshot,
                              sensing::SceneDraft* scene) {
  if (state_.devices != nullptr) return false;
  const double step_seconds = base::ToSeconds(step);
  snapshot.accelerations.resize(state_.bodies.size());
  snapshot.joint_accelerations.resize(state_.joint_velocities.size());
  snapshot.state.bodies.resize(state_.bodies.size());
  wheel_odometry_.KeepWheels(state_);
  StepFinisher finisher(step_seconds, *layout_, wheel_odometry_, state_, snapshot, scene);
  if (!engine_->StepMany(step, steps, state_, snapshot.contacts, finisher)) return false;
  state_.step += steps;
  state_.time = state_.step * step;
  world::FinishJointAccelerations(state_.joint_velocities, step_seconds,
                                  snapshot.joint_accelerations);
  CopyAllButBodies(snapshot.state);
  return true;
}

int SimulatedWorld::Step(base::SimTime step, int max_steps, world::Snapshot& snapshot,
                         sensing::SceneDraft* scene) {
  snapshot.step_length = step;
  snapshot.layout = layout_;
  if (max_steps > 1 && StepMany(step, max_steps, snapshot, scene)) return max_steps;
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
  ++state_.step;
  state_.time = state_.step * step;
  FinishStep(base::ToSeconds(step), snapshot);
  return 1;
}

void SimulatedWorld::CopyAllButBodies(world::State& to) {
  std::vector<world::BodyState> bodies = std::move(state_.bodies);
  std::vector<world::BodyState> copies = std::move(to.bodies);
  to = state_;
  state_.bodies = std::move(bodies);
  to.bodies = std::move(copies);
}

// Completes the step in one pass over the bodies, so that the state of each body is loaded into the
// cache only once.
void SimulatedWorld::FinishStep(double step_seconds, world::Snapshot& snapshot) {
  world::FinishContacts(state_, snapshot.accelerations, snapshot.contacts);
  world::FinishJointAccelerations(state_.joint_velocities, step_seconds,
                                  snapshot.joint_accelerations);
  CopyAllButBodies(snapshot.state);
  snapshot.state.bodies.resize(state_.bodies.size());
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
