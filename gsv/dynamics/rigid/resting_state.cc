#include "gsv/dynamics/rigid/resting_state.h"

#include <algorithm>

namespace gsv::dynamics {
namespace {

// Appends the state of the body to `values`: all numbers that a step reads or changes.
void Append(const RigidBody& body, const world::State& state, std::vector<double>& values) {
  const world::BodyState& s = state.bodies[body.body];
  const auto& [p, q] = s.world_from_model;
  const geometry::Vector3 &v = s.linear_velocity, &w = s.angular_velocity;
  values.insert(values.end(), {p.x, p.y, p.z, q.w, q.x, q.y, q.z, v.x, v.y, v.z, w.x, w.y, w.z});
  for (std::size_t j = 0; j < body.model->joints.size(); ++j) {
    values.push_back(state.joint_positions[body.first_joint + j]);
    values.push_back(state.joint_velocities[body.first_joint + j]);
  }
}

std::vector<double> ValuesOf(const RigidScene& scene, const world::State& state) {
  std::vector<double> values;
  for (const RigidBody& body : scene.bodies()) Append(body, state, values);
  return values;
}

bool AnyNear(const RigidScene& scene, const world::State& before, const world::State& after,
             const std::vector<Area>& areas) {
  return std::any_of(scene.planar().begin(), scene.planar().end(),
                     [&](const Solid& planar) { return IsNear(planar, before, after, areas); });
}

}  // namespace

void RestingState::Remember(const RigidScene& scene, const world::State& before,
                            const world::State& after, double seconds, std::vector<Area> areas) {
  state_ = ValuesOf(scene, after);
  // Commands may move a body with a drive, even if its state has not changed.
  const bool commanded =
      std::any_of(scene.bodies().begin(), scene.bodies().end(),
                  [](const RigidBody& body) { return body.kinematics.has_value(); });
  engine_ = after.engine;
  areas_ = std::move(areas);
  seconds_ = seconds;
  rests_ = !commanded && after.engine == before.engine && state_ == ValuesOf(scene, before) &&
           !AnyNear(scene, before, after, areas_);
}

bool RestingState::Holds(const RigidScene& scene, const world::State& before,
                         const world::State& after, double seconds) const {
  return rests_ && before.joint_commands.empty() && seconds == seconds_ &&
         before.engine == engine_ && state_ == ValuesOf(scene, before) &&
         !AnyNear(scene, before, after, areas_);
}

}  // namespace gsv::dynamics
