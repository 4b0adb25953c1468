#include "gsv/formats/sdf/loop_gap.h"

#include <cmath>

namespace gsv::formats {
namespace {

using geometry::Pose;
using model::JointKind;

// Returns the motion of a joint's child in the model's frame, from its pose at position 0.
Pose MotionOf(const model::Joint& joint, double position) {
  Pose motion;
  if (joint.kind == JointKind::kPrismatic) {
    motion.position = position * joint.axis;
  } else {
    const geometry::Vector3 half = std::sin(position / 2) * joint.axis;
    motion.orientation = {std::cos(position / 2), half.x, half.y, half.z};
    motion.position = (joint.thread_pitch * position) * joint.axis;
  }
  return joint.model_from_joint * motion * Inverse(joint.model_from_joint);
}

Pose MotionOfLink(const model::Model& model, int link) {
  Pose motion;
  for (std::size_t level = 0; link >= 0 && level <= model.links.size(); ++level) {
    int parent = -1;
    for (std::size_t i = 0; i < model.joints.size(); ++i) {
      if (model.joints[i].child != link) continue;
      motion = MotionOf(model.joints[i], model.start_positions[i]) * motion;
      parent = model.joints[i].parent;
      break;
    }
    link = parent;
  }
  return motion;
}

}  // namespace

double LoopGap(const model::Model& model, const model::Joint& loop) {
  if (model.start_positions.size() != model.joints.size()) return 0;
  const Pose first = MotionOfLink(model, loop.parent) * loop.model_from_joint;
  const Pose second = MotionOfLink(model, loop.child) * loop.model_from_joint;
  geometry::Vector3 gap = (Inverse(first) * second).position;
  if (loop.kind == JointKind::kPrismatic) gap -= Dot(gap, loop.axis) * loop.axis;
  return Norm(gap);
}

}  // namespace gsv::formats
