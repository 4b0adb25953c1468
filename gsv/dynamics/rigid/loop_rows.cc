#include "gsv/dynamics/rigid/loop_rows.h"

#include <algorithm>
#include <cmath>

namespace gsv::dynamics {
namespace {

using geometry::Pose;
using geometry::Vector3;
using model::JointKind;

constexpr double kLoopCorrection = 0.2;  // fraction of the drift that a substep corrects

int LinearRows(JointKind kind) { return kind == JointKind::kPrismatic ? 2 : 3; }

int AngularRows(JointKind kind) {
  if (kind == JointKind::kBall) return 0;
  return kind == JointKind::kRevolute || kind == JointKind::kContinuous ? 2 : 3;
}

// Returns the shortest rotation of the z axis to `axis`.
geometry::Quaternion FromZTo(const Vector3& axis) {
  const Vector3 z{0, 0, 1}, across = Cross(z, axis);
  if (axis.z < -1 + 1e-12) return {0, 1, 0, 0};
  return geometry::Normalized({1 + axis.z, across.x, across.y, across.z});
}

// Returns the indices of the velocities that move one of the two parts, in ascending order and each
// once.
std::vector<int> VelocitiesOf(const LinkTree& tree, int first, int second) {
  std::vector<int> velocities;
  for (const int part : {first, second}) {
    const auto chain = tree.Chain(part);
    velocities.insert(velocities.end(), chain.begin(), chain.end());
  }
  std::sort(velocities.begin(), velocities.end());
  velocities.erase(std::unique(velocities.begin(), velocities.end()), velocities.end());
  return velocities;
}

}  // namespace

void LoopJoint::AddRows(const LinkTree& tree, double seconds, JointRows& rows) const {
  const Pose first = tree.pose(first_.part) * first_.part_from_joint;
  const Pose second = tree.pose(second_.part) * second_.part_from_joint;
  const Matrix3 a = MatrixOf(first.orientation), b = MatrixOf(second.orientation);
  const Vector3 gap = second.position - first.position;
  const Vector3 rotation = AngularRows(kind_) == 2
                               ? Cross(a.z, b.z)
                               : 0.5 * (Cross(a.x, b.x) + Cross(a.y, b.y) + Cross(a.z, b.z));
  const Vector3 axes[] = {a.x, a.y, a.z};
  const std::vector<int> velocities = VelocitiesOf(tree, first_.part, second_.part);
  // The motion of the first end relative to the second, due to a unit of each velocity.
  std::vector<LinkTree::Motion> motions(velocities.size());
  std::vector<Vector3> of_point;
  for (const double sign : {1.0, -1.0}) {
    const int part = sign > 0 ? first_.part : second_.part;
    tree.PointMotions(part, second.position, of_point);
    const auto chain = tree.Chain(part);
    for (std::size_t k = 0; k < chain.size(); ++k) {
      const auto at = std::lower_bound(velocities.begin(), velocities.end(), chain[k]);
      LinkTree::Motion& motion = motions[static_cast<std::size_t>(at - velocities.begin())];
      motion.moving += sign * of_point[k];
      motion.turning += sign * tree.turning(chain[k]);
    }
  }
  const auto add = [&](const Vector3& axis, const Vector3& error, bool is_linear) {
    JointRow& row = rows.AddEmpty();
    row.target = kLoopCorrection / seconds * Dot(axis, error);
    for (std::size_t k = 0; k < velocities.size(); ++k) {
      const double value = Dot(axis, is_linear ? motions[k].moving : motions[k].turning);
      if (value != 0) rows.AddValue(velocities[k], value);
    }
  };
  for (int i = 0; i < LinearRows(kind_); ++i) add(axes[i], gap, true);
  for (int i = 0; i < AngularRows(kind_); ++i) add(axes[i], rotation, false);
}

std::vector<LoopJoint> LoopJointsOf(const RigidBody& plan) {
  const auto end_of = [&](int link, const model::Joint& joint) -> LoopJoint::End {
    // Link -1 is the world. The base does not move in that case, so the end is attached to the
    // base.
    const int part = link < 0 ? 0 : plan.articulation.part_of_link[static_cast<std::size_t>(link)];
    const Pose& model_from_part =
        plan.articulation.parts[static_cast<std::size_t>(part)].model_from_part;
    return {part,
            Inverse(model_from_part) * joint.model_from_joint * Pose{{}, FromZTo(joint.axis)}};
  };
  std::vector<LoopJoint> joints;
  for (const model::Joint& joint : plan.model->loop_joints) {
    const LoopJoint::End parent = end_of(joint.parent, joint), child = end_of(joint.child, joint);
    if (parent.part != child.part) joints.emplace_back(parent, child, joint.kind);
  }
  return joints;
}

}  // namespace gsv::dynamics
