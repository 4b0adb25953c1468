#include "gsv/sensing/devices/link_motion.h"

#include <algorithm>
#include <span>
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

// The state of a body. Without accelerations, `acceleration` is 0 and `joint_accelerations` empty.
struct Source {
  Source(const world::Layout& layout, const world::State& all, int index)
      : body(layout.bodies[static_cast<std::size_t>(index)]),
        state(all.bodies[static_cast<std::size_t>(index)]),
        joint_positions(OfJoints(all.joint_positions)),
        joint_velocities(OfJoints(all.joint_velocities)) {}
  Source(const world::Snapshot& snapshot, int index)
      : Source(*snapshot.layout, snapshot.state, index) {
    if (!snapshot.accelerations.empty()) {
      acceleration = snapshot.accelerations[static_cast<std::size_t>(index)];
    }
    if (!snapshot.joint_accelerations.empty()) {
      joint_accelerations = OfJoints(snapshot.joint_accelerations);
    }
  }

  std::span<const double> OfJoints(const std::vector<double>& all) const {
    return std::span(all).subspan(static_cast<std::size_t>(body.first_joint),
                                  body.model->joints.size());
  }
  std::vector<Pose> WorldFromLinks() const {
    std::vector<Pose> poses = world::LinkPoses(*body.model, joint_positions);
    for (Pose& pose : poses) pose = state.world_from_model * pose;
    return poses;
  }

  const world::Body& body;
  const world::BodyState& state;
  world::Acceleration acceleration;
  std::span<const double> joint_positions, joint_velocities, joint_accelerations;
};

// Returns the motion of the links above all joints, at the origin of the model.
LinkMotion MotionOfBase(const Source& source) {
  LinkMotion base;
  base.place = source.state.world_from_model.position;
  base.velocity = source.state.linear_velocity;
  base.angular_velocity = source.state.angular_velocity;
  base.acceleration = source.acceleration.linear;
  base.angular_acceleration = source.acceleration.angular;
  return base;
}

class MotionReader {
 public:
  explicit MotionReader(const Source& source)
      : source_(source),
        poses_(source.WorldFromLinks()),
        above_(poses_.size(), -1),
        is_known_(poses_.size()) {
    for (std::size_t j = 0; j < model().joints.size(); ++j) {
      above_[static_cast<std::size_t>(model().joints[j].child)] = static_cast<int>(j);
    }
    motions_.assign(poses_.size(), MotionOfBase(source));
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
  const model::Model& model() const { return *source_.body.model; }
  const model::Joint& JointAbove(int link) const {
    const int joint = above_[static_cast<std::size_t>(link)];
    return model().joints[static_cast<std::size_t>(joint)];
  }

  double RateOf(int joint) const {
    return source_.joint_velocities[static_cast<std::size_t>(joint)];
  }
  double AccelerationOf(int joint) const {
    const auto at = static_cast<std::size_t>(joint);
    return at < source_.joint_accelerations.size() ? source_.joint_accelerations[at] : 0;
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

  const Source source_;
  const std::vector<Pose> poses_;
  std::vector<int> above_;  // the joint above each link, or -1
  std::vector<bool> is_known_;
  std::vector<LinkMotion> motions_;
};

bool IsBelowAJoint(const Source& source, int link) {
  const auto& joints = source.body.model->joints;
  return std::any_of(joints.begin(), joints.end(),
                     [&](const model::Joint& joint) { return joint.child == link; });
}

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
  const Source source(snapshot, body);
  if (IsBelowAJoint(source, link)) return MotionReader(source).Read(link);
  LinkMotion motion = MotionOfBase(source);  // without the poses of all links
  motion.world_from_link = world::LinkPose(snapshot, body, link);
  return motion;
}

LinkMotion MotionOfLink(const world::Layout& layout, const world::State& state, int body,
                        int link) {
  return MotionReader(Source(layout, state, body)).Read(link);
}

std::vector<LinkMotion> MotionsOfLinks(const world::Snapshot& snapshot, int body) {
  return MotionReader(Source(snapshot, body)).ReadAll();
}

}  // namespace gsv::sensing
