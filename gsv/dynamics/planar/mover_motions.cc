#include "gsv/dynamics/planar/mover_motions.h"

namespace gsv::dynamics {
void MoverMotions::Resize() {
  const std::size_t count = scene_.movers().size();
  positions.resize(count);
  drives.resize(count);
  twists.resize(count);
  times.resize(count);
  reaches.resize(count);
  normals.resize(count);
}

void MoverMotions::Store(std::uint32_t m, const Journey& journey, double seconds,
                         world::State& state) const {
  const Mover& mover = scene_.movers()[m];
  world::BodyState& body = state.bodies[mover.body];
  const geometry::PlanarPosition& at = positions[m];
  body.world_from_model.position.x = at.x;
  body.world_from_model.position.y = at.y;
  if (journey.travel.angle != 0) {
    body.world_from_model.orientation =
        Normalized(geometry::FromAxisAngle({0, 0, 1}, journey.travel.angle) *
                   body.world_from_model.orientation);
  }
  const geometry::Twist twist = kinematics(m).OriginTwist(drives[m]);
  body.linear_velocity = {at.cosine * twist.x - at.sine * twist.y,
                          at.sine * twist.x + at.cosine * twist.y, 0};
  body.angular_velocity = {0, 0, twist.angular};
  body.drive.actual = drives[m];
  body.distance += journey.distance;
  if (!kinematics(m).turns_joints()) return;
  kinematics(m).TurnJoints(
      journey.travel, drives[m], seconds,
      std::span(state.joint_positions).subspan(mover.first_joint, mover.joint_count),
      std::span(state.joint_velocities).subspan(mover.first_joint, mover.joint_count));
}

}  // namespace gsv::dynamics
