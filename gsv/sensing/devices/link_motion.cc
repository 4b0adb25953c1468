#include "gsv/sensing/devices/link_motion.h"

#include <algorithm>
#include <utility>

namespace gsv::sensing {
namespace {

using geometry::Cross;
using geometry::Pose;
using geometry::Vector3;
using model::JointKind;

// Moves `motion`, which is at a joint, to the link below the joint. `rate` and `acceleration` are
// along or about `axis`. `around` is the angular velocity of the link above the joint.
void PassJoint(const model::Joint& joint, const Vector3& axis, const Vector3& around, double rate,
               double acceleration, LinkMotion& motion) {
  const bool slides = joint.kind == JointKind::kPrismatic;
  if (!slides) {
    motion.angular_acceleration += acceleration * axis + rate * Cross(around, axis);
    motion.angular_velocity += rate * axis;
  }
  double travel = slides ? 1 : 0;
  if (joint.kind == JointKind::kScrew) travel = joint.thread_pitch;
  motion.velocity += travel * rate * axis;
  motion.acceleration += travel * (acceleration * axis + 2 * rate * Cross(around, axis));
}

// Returns the motion of the links above all joints, at the origin of the model.
LinkMotion MotionOfBase(const world::Snapshot& snapshot, int body) {
  const world::BodyState& state = snapshot.state.bodies[static_cast<std::size_t>(body)];
  LinkMotion base;
  base.place = state.world_from_model.position;
  base.velocity = state.linear_velocity;
  base.angular_velocity = state.angular_velocity;
  if (!snapshot.accelerations.empty()) {
    const world::Acceleration& mean = snapshot.accelerations[static_cast<std::size_t>(body)];
    base.acceleration = mean.linear;
    base.angular_acceleration = mean.angular;
  }
  return base;
}

class MotionReader {
 public:
  MotionReader(const world::Snapshot& snapshot, int body)
      : snapshot_(snapshot),
        body_(snapshot.layout->bodies[static_cast<std::size_t>(body)]),
        poses_(world::LinkPoses(snapshot, body)),
        above_(poses_.size(), -1),
        is_known_(poses_.size()) {
    for (std::size_t j = 0; j < model().joints.size(); ++j) {
      above_[static_cast<std::size_t>(model().joints[j].child)] = static_cast<int>(j);
    }
    motions_.assign(poses_.size(), MotionOfBase(snapshot, body));
  }

  const LinkMotion& Read(int link) {
    std::vector<int> chain;  // a link and the links above it whose motion is not known yet
    for (int at = link; at >= 0 && !is_known_[static_cast<std::size_t>(at)];) {
      chain.push_back(at);
      at = above_[static_cast<std::size_t>(at)] < 0 ? -1 : JointAbove(at).parent;
    }
    for (std::size_t level = chain.size(); level-- > 0;) ReadLink(chain[level]);
    return motions_[static_cast<std::size_t>(link)];
  }

  std::vector<LinkMotion> ReadAll() && {
    for (std::size_t link = 0; link < motions_.size(); ++link) Read(static_cast<int>(link));
    return std::move(motions_);
  }

 private:
  const model::Model& model() const { return *body_.model; }
  const model::Joint& JointAbove(int link) const {
    const int joint = above_[static_cast<std::size_t>(link)];
    return model().joints[static_cast<std::size_t>(joint)];
  }

  // Returns the index of a joint in the state's arrays of joint values.
  std::size_t PlaceOf(int joint) const {
    return static_cast<std::size_t>(body_.first_joint + joint);
  }
  double RateOf(int joint) const { return snapshot_.state.joint_velocities[PlaceOf(joint)]; }
  double AccelerationOf(int joint) const {
    const std::size_t place = PlaceOf(joint);
    return place < snapshot_.joint_accelerations.size() ? snapshot_.joint_accelerations[place] : 0;
  }

  // Returns the number of consecutive ball joints directly above a link. Each ball joint is three
  // joints.
  int BallsAbove(int link) const {
    int count = 0;
    for (; link >= 0 && above_[static_cast<std::size_t>(link)] >= 0; ++count) {
      const model::Joint& joint = JointAbove(link);
      if (joint.kind != JointKind::kBall) break;
      link = joint.parent;
    }
    return count;
  }

  void ReadLink(int link) {
    const auto of = static_cast<std::size_t>(link);
    LinkMotion& motion = motions_[of];
    is_known_[of] = true;
    const int above = above_[of];
    if (above >= 0) {
      const model::Joint& joint = JointAbove(link);
      if (joint.parent >= 0) motion = motions_[static_cast<std::size_t>(joint.parent)];
      const Pose world_from_joint =
          poses_[of] * Inverse(model().links[of].model_from_link) * joint.model_from_joint;
      motion.MoveTo(world_from_joint.position);
      if (joint.kind == JointKind::kBall) {
        if (BallsAbove(link) % 3 == 0) PassBall(above, world_from_joint, motion);
      } else if (joint.kind != JointKind::kFixed) {
        PassJoint(joint, world_from_joint.orientation * joint.axis, motion.angular_velocity,
                  RateOf(above), AccelerationOf(above), motion);
      }
    }
    motion.world_from_link = poses_[of];
  }

  // Moves `motion`, which is at a ball joint, to the link below the ball joint. The rates of the
  // ball joint's three joints are about the axes of this link. `last` is the third of these joints.
  void PassBall(int last, const Pose& world_from_joint, LinkMotion& motion) {
    const Vector3 around = motion.angular_velocity;
    for (int joint = last, i = 0; i < 3; ++i) {
      const model::Joint& of = model().joints[static_cast<std::size_t>(joint)];
      PassJoint(of, world_from_joint.orientation * of.axis, around, RateOf(joint),
                AccelerationOf(joint), motion);
      joint = of.parent < 0 ? last : above_[static_cast<std::size_t>(of.parent)];
    }
  }

  const world::Snapshot& snapshot_;
  const world::Body& body_;
  const std::vector<Pose> poses_;
  std::vector<int> above_;  // the joint above each link, or -1
  std::vector<bool> is_known_;
  std::vector<LinkMotion> motions_;
};

}  // namespace

Vector3 LinkMotion::AccelerationOf(const Vector3& point) const {
  const Vector3 arm = point - place;
  return acceleration +
         (Cross(angular_acceleration, arm) + Cross(angular_velocity, Cross(angular_velocity, arm)));
}

void LinkMotion::MoveTo(const Vector3& point) {
  acceleration = AccelerationOf(point);
  velocity += Cross(angular_velocity, point - place);
  place = point;
}

LinkMotion MotionOfLink(const world::Snapshot& snapshot, int body, int link) {
  const auto& joints = snapshot.layout->bodies[static_cast<std::size_t>(body)].model->joints;
  const bool is_below_a_joint = std::any_of(
      joints.begin(), joints.end(), [&](const model::Joint& joint) { return joint.child == link; });
  if (is_below_a_joint) return MotionReader(snapshot, body).Read(link);
  LinkMotion motion = MotionOfBase(snapshot, body);  // without the poses of all links
  motion.world_from_link = world::LinkPose(snapshot, body, link);
  return motion;
}

std::vector<LinkMotion> MotionsOfLinks(const world::Snapshot& snapshot, int body) {
  return MotionReader(snapshot, body).ReadAll();
}

}  // namespace gsv::sensing
