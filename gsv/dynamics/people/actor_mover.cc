#include "gsv/dynamics/people/actor_mover.h"

#include <cmath>

namespace gsv::dynamics {
namespace {

using geometry::Pose;
using geometry::Vector3;

// The angular velocity (world axes) that turns `from` into `to` in so many seconds.
Vector3 RateBetween(const geometry::Quaternion& from, const geometry::Quaternion& to,
                    double seconds) {
  geometry::Quaternion turn = to * Inverse(from);
  if (turn.w < 0) turn = {-turn.w, -turn.x, -turn.y, -turn.z};
  const Vector3 axis{turn.x, turn.y, turn.z};
  const double sine = geometry::Norm(axis);
  if (!(sine > 0)) return {};
  return axis * (2 * std::atan2(sine, turn.w) / (sine * seconds));
}

}  // namespace

void ActorMover::SetLayout(const std::shared_ptr<const world::Layout>& layout) {
  layout_ = layout;
  actors_.clear();
  for (std::size_t i = 0; i < layout->bodies.size(); ++i) {
    const world::Body& body = layout->bodies[i];
    if (!body.is_actor()) continue;
    const model::Script* script = body.model->script.get();
    actors_.push_back(
        {static_cast<int>(i), script, body.initial_pose * Inverse(model::StartPose(*script))});
  }
}

void ActorMover::Move(base::SimTime step, world::State& state, world::State* before) const {
  const double seconds = base::ToSeconds(step);
  for (const Actor& actor : actors_) {
    const ScriptInstant now = InstantOf(*actor.script, state.time);
    const ScriptInstant then = InstantOf(*actor.script, state.time + step);
    world::BodyState& body = state.bodies[static_cast<std::size_t>(actor.body)];
    const Pose start = body.world_from_model;
    body.world_from_model = actor.world_from_trajectory * then.pose;
    body.linear_velocity = body.angular_velocity = {};
    const bool jumps = now.cycle != then.cycle || now.trajectory != then.trajectory;
    const Vector3 way = body.world_from_model.position - start.position;
    if (jumps && !(geometry::Norm(way) < 0.1)) {
      if (before != nullptr) {
        before->bodies[static_cast<std::size_t>(actor.body)].world_from_model =
            body.world_from_model;
      }
      continue;
    }
    body.distance += geometry::Norm(way);
    body.linear_velocity = way * (1 / seconds);
    body.angular_velocity =
        RateBetween(start.orientation, body.world_from_model.orientation, seconds);
  }
}

}  // namespace gsv::dynamics
