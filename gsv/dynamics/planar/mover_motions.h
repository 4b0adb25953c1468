// The positions of all movers within a step, and their motions in the current leg. A mover is a
// body that planar kinematics moves. A leg is a part of the step with a constant twist.
//
// Units    metres, radians, seconds; positions in the world frame, motions in the frame of each
//          mover.
// Threads  calls for different movers may run concurrently.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

#include "gsv/dynamics/planar/planar_scene.h"
#include "gsv/geometry/planar_motion.h"
#include "gsv/world/state.h"

namespace gsv::dynamics {

// Returns the position and heading of a body in the plane. The heading is a cosine and a sine, so
// no angle is computed.
inline geometry::PlanarPosition PositionOf(const geometry::Pose& pose) {
  const geometry::Quaternion& q = pose.orientation;
  const double cosine = 1 - 2 * (q.y * q.y + q.z * q.z), sine = 2 * (q.w * q.z + q.x * q.y);
  const double length = std::sqrt(cosine * cosine + sine * sine);
  if (!(length > 0)) return {pose.position.x, pose.position.y, 1, 0};
  return {pose.position.x, pose.position.y, cosine / length, sine / length};
}

// Returns the linear speed of the origin, m/s.
inline double SpeedOf(const geometry::Twist& twist) {
  return twist.y == 0 ? std::abs(twist.x) : std::sqrt(twist.x * twist.x + twist.y * twist.y);
}

// The sum of a mover's motions over the legs of a step.
struct Journey {
  Travel travel;        // of the drive's reference point, in the mover's frame
  double distance = 0;  // length of the path of the model's origin, m
};

// The positions and motions of all movers within one step.
class MoverMotions {
 public:
  explicit MoverMotions(const PlanarScene& scene) : scene_(scene) {}

  // Allocates an entry for each of the scene's movers.
  void Resize();

  // Sets a mover's position from `state`.
  void Load(std::uint32_t mover, const world::State& state);
  // Starts the first leg of a step. The step takes `seconds` from the time `now`. The mover follows
  // its command. With 0 s, it does not move.
  void FollowCommand(std::uint32_t mover, const world::State& state, base::SimTime now,
                     double seconds);
  // Sets reaches[mover] to an upper bound of the distance that any part of the mover moves in the
  // next `steps` steps together. Each step takes `seconds`.
  void SetReach(std::uint32_t mover, const world::State& state, double seconds, int steps);
  // Starts a leg with this twist.
  void SetLeg(std::uint32_t mover, const geometry::Twist& twist, double seconds);
  // Moves the mover to the end of its leg.
  void RunLeg(std::uint32_t mover, Journey& journey);
  // Whether the next step of a mover will equal its last step, if its command remains in effect.
  // This is so if the last step neither rotated the mover nor changed the drive's velocity, and the
  // drive turns no joints. `before` is the drive's velocity before the last step. Call after
  // Store().
  bool IsStraightAndSteady(std::uint32_t mover, const world::DriveCommand& before) const;
  // Moves a mover by further steps which equal its last step. `journey` is that of the last step.
  void Repeat(std::uint32_t mover, const Journey& journey, int steps, world::State& state);
  // Writes the mover's pose, velocity and wheel angles to `state`.
  void Store(std::uint32_t mover, const Journey& journey, double seconds,
             world::State& state) const;

  const DriveKinematics& kinematics(std::uint32_t mover) const {
    return scene_.kind(scene_.movers()[mover]).kinematics;
  }

  // One entry for each of the scene's movers.
  std::vector<geometry::PlanarPosition> positions;
  std::vector<world::DriveCommand> drives;  // motion of the drive, updated after each leg
  std::vector<geometry::Twist> twists;      // twist in this leg
  std::vector<double> times;                // duration of the motion in this leg, s; 0 at rest
  std::vector<double> reaches;              // maximum distance that any part moves in this step, or
                                            // in the steps of SetReach(), m
  std::vector<Vector2> normals;  // direction towards the obstacle that has stopped the mover

 private:
  const PlanarScene& scene_;
};

// The following functions run for each mover in each step, so they are always inlined.

[[gnu::always_inline]] inline void MoverMotions::Load(std::uint32_t mover,
                                                      const world::State& state) {
  positions[mover] = PositionOf(state.bodies[scene_.movers()[mover].body].world_from_model);
}

[[gnu::always_inline]] inline void MoverMotions::FollowCommand(std::uint32_t m,
                                                               const world::State& state,
                                                               base::SimTime now, double seconds) {
  const Mover& mover = scene_.movers()[m];
  const MoverKind& kind = scene_.kind(mover);
  drives[m] = seconds > 0 ? kind.kinematics.Next(state.bodies[mover.body].drive, now, seconds)
                          : world::DriveCommand{};
  SetLeg(m, kind.kinematics.OriginTwist(drives[m]), seconds);
  reaches[m] = (SpeedOf(twists[m]) + std::abs(twists[m].angular) * kind.spin_radius) * seconds;
}

inline void MoverMotions::SetReach(std::uint32_t m, const world::State& state, double seconds,
                                   int steps) {
  const Mover& mover = scene_.movers()[m];
  const MoverKind& kind = scene_.kind(mover);
  const DriveKinematics::Speeds bound =
      kind.kinematics.MaxSpeeds(state.bodies[mover.body].drive, steps);
  reaches[m] = (bound.linear + bound.angular * kind.spin_radius) * seconds * steps;
}

[[gnu::always_inline]] inline void MoverMotions::SetLeg(std::uint32_t m,
                                                        const geometry::Twist& twist,
                                                        double seconds) {
  twists[m] = twist;
  times[m] = Moves(twist) ? seconds : 0;
}

[[gnu::always_inline]] inline void MoverMotions::RunLeg(std::uint32_t m, Journey& journey) {
  const double time = times[m];
  if (time <= 0) return;
  const geometry::Twist& twist = twists[m];
  positions[m] = Advance(positions[m], twist, time);
  journey.distance += SpeedOf(twist) * time;
  journey.travel.forward += twist.x * time;
  journey.travel.left += (twist.y + twist.angular * kinematics(m).reference_x()) * time;
  journey.travel.angle += twist.angular * time;
}

[[gnu::always_inline]] inline bool MoverMotions::IsStraightAndSteady(
    std::uint32_t m, const world::DriveCommand& before) const {
  // Compares the bits, not the values: only from equal bits does the next step surely compute the
  // same velocity again.
  return twists[m].angular == 0 && std::memcmp(&before, &drives[m], sizeof before) == 0 &&
         !kinematics(m).turns_joints();
}

// Does the same operations as RunLeg() and Store() in each step. It omits the values that these
// functions would write unchanged.
[[gnu::always_inline]] inline void MoverMotions::Repeat(std::uint32_t m, const Journey& journey,
                                                        int steps, world::State& state) {
  if (times[m] <= 0) return;
  // The sums stay in registers, because a load of two numbers at once would have to wait until both
  // were written to the cache.
  geometry::PlanarPosition at = positions[m];
  world::BodyState& body = state.bodies[scene_.movers()[m].body];
  double distance = body.distance;
  for (int i = 0; i < steps; ++i) {
    at = Advance(at, twists[m], times[m]);
    distance += journey.distance;
  }
  positions[m] = at;
  body.distance = distance;
  body.world_from_model.position.x = at.x;
  body.world_from_model.position.y = at.y;
}

}  // namespace gsv::dynamics
