#include "gsv/dynamics/people/actor_mover.h"

#include <algorithm>
#include <cmath>

namespace gsv::dynamics {
namespace {

using geometry::Vector3;

// Returns the angular velocity (world axes) that rotates `from` into `to` in `seconds`.
Vector3 RateBetween(const geometry::Quaternion& from, const geometry::Quaternion& to,
                    double seconds) {
  geometry::Quaternion turn = to * Inverse(from);
  if (turn.w < 0) turn = {-turn.w, -turn.x, -turn.y, -turn.z};
  const Vector3 axis{turn.x, turn.y, turn.z};
  const double sine = geometry::Norm(axis);
  if (!(sine > 0)) return {};
  return axis * (2 * std::atan2(sine, turn.w) / (sine * seconds));
}

constexpr int kSamples = 32;

// Divides each section between two waypoints into kSamples intervals of equal time. Returns the
// distance (m) from the start of the trajectory to the start, and to the end of each interval.
std::vector<double> WaysAlong(const model::Trajectory& trajectory) {
  std::vector<double> ways{0};
  Vector3 last = trajectory.waypoints[0].pose.position;
  for (std::size_t i = 0; i + 1 < trajectory.waypoints.size(); ++i) {
    const base::SimTime start = trajectory.waypoints[i].time;
    const base::SimTime span = trajectory.waypoints[i + 1].time - start;
    for (int k = 1; k <= kSamples; ++k) {
      const Vector3 at = PoseOn(trajectory, start + span * k / kSamples).position;
      ways.push_back(ways.back() + geometry::Norm(at - last));
      last = at;
    }
  }
  return ways;
}

double WayAt(const model::Trajectory& trajectory, const std::vector<double>& ways,
             base::SimTime since) {
  const auto& points = trajectory.waypoints;
  std::size_t i = 0;
  while (i + 1 < points.size() && points[i + 1].time <= since) ++i;
  if (i + 1 == points.size()) return ways.back();
  const double part = base::ToSeconds(since - points[i].time) /
                      base::ToSeconds(points[i + 1].time - points[i].time) * kSamples;
  const double whole = std::floor(part);
  const std::size_t at = i * kSamples + static_cast<std::size_t>(whole);
  return ways[at] + (part - whole) * (ways[std::min(at + 1, ways.size() - 1)] - ways[at]);
}

// Returns the index of an animation's frame. `share` is the number of times that the animation has
// run: 1.5 is the middle of the second time.
int FrameAt(const model::Animation& animation, double share) {
  const int count = animation.frame_count();
  return std::min(count - 1, static_cast<int>((share - std::floor(share)) * count));
}

}  // namespace

void ActorMover::Pose(const Actor& actor, const ScriptInstant& instant, world::State& state) {
  const model::Animation* animation = actor.script->animation.get();
  if (animation == nullptr || animation->frame_count() == 0) return;
  double share = base::ToSeconds(instant.since) / base::ToSeconds(animation->length);
  if (instant.trajectory < actor.ways.size() && animation->distance > 0) {
    const model::Trajectory& trajectory = actor.script->trajectories[instant.trajectory];
    if (trajectory.animated_by_distance) {
      share =
          WayAt(trajectory, actor.ways[instant.trajectory], instant.since) / animation->distance;
    }
  }
  const auto from =
      animation->positions.begin() +
      static_cast<std::ptrdiff_t>(FrameAt(*animation, share)) * animation->joint_count;
  std::copy_n(from, animation->joint_count, state.joint_positions.begin() + actor.first_joint);
}

void ActorMover::SetLayout(const std::shared_ptr<const world::Layout>& layout) {
  layout_ = layout;
  actors_.clear();
  for (std::size_t i = 0; i < layout->bodies.size(); ++i) {
    const world::Body& body = layout->bodies[i];
    if (!body.is_actor()) continue;
    const model::Script* script = body.model->script.get();
    actors_.push_back({static_cast<int>(i),
                       script,
                       body.initial_pose * Inverse(model::StartPose(*script)),
                       body.first_joint,
                       {}});
    for (const model::Trajectory& trajectory : script->trajectories) {
      actors_.back().ways.push_back(WaysAlong(trajectory));
    }
  }
}

void ActorMover::Move(base::SimTime step, world::State& state, world::State* before) const {
  const double seconds = base::ToSeconds(step);
  for (const Actor& actor : actors_) {
    const ScriptInstant now = InstantOf(*actor.script, state.time);
    const ScriptInstant then = InstantOf(*actor.script, state.time + step);
    world::BodyState& body = state.bodies[static_cast<std::size_t>(actor.body)];
    const geometry::Pose start = body.world_from_model;
    body.world_from_model = actor.world_from_trajectory * then.pose;
    Pose(actor, then, state);
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
