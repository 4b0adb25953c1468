#include "gsv/formats/sdf/sdf_joint.h"

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <sdf/Element.hh>
#include <sdf/JointAxis.hh>

namespace gsv::formats {
namespace {

using model::Joint;
using model::JointKind;

constexpr double kNoLimit = 1e15;  // larger values mean "no limit": SDFormat writes 1e16

double LimitOrInfinity(double value) {
  return std::abs(value) >= kNoLimit ? std::copysign(INFINITY, value) : value;
}

// Returns a limit, or infinity if there is none: SDFormat writes -1 for "none".
double BoundOrInfinity(double value) { return value >= 0 && value < kNoLimit ? value : INFINITY; }

void ReadAxis(const sdf::JointAxis& axis, const std::string& place, const ReadingContext& context,
              Joint& joint) {
  ignition::math::Vector3d xyz;
  if (!axis.ResolveXyz(xyz).empty() || !geometry::IsFinite(FromIgnition(xyz)) ||
      !(xyz.Length() > 0) || !std::isfinite(xyz.Length())) {
    context.Warn("the joint's axis is zero; the z axis is used", place);
    xyz = {0, 0, 1};
  }
  joint.axis = geometry::Normalized(FromIgnition(xyz));
  joint.position_limits = {LimitOrInfinity(axis.Lower()), LimitOrInfinity(axis.Upper())};
  if (!(joint.position_limits.min <= joint.position_limits.max)) {
    context.Warn("the joint's <lower> limit is above its <upper>; both are dropped", place);
    joint.position_limits = {};
  }
  if (joint.kind == JointKind::kRevolute && std::isinf(joint.position_limits.min) &&
      std::isinf(joint.position_limits.max)) {
    joint.kind = JointKind::kContinuous;
  }
  joint.effort_limit = BoundOrInfinity(axis.Effort());
  joint.velocity_limit = BoundOrInfinity(axis.MaxVelocity());
  joint.damping = axis.Damping();
  joint.friction = axis.Friction();
  if (!(joint.damping >= 0) || !(joint.friction >= 0) || std::isinf(joint.damping) ||
      std::isinf(joint.friction)) {
    context.Warn("a joint's damping and friction must be finite and not negative; 0 is used",
                 place);
    joint.damping = joint.friction = 0;
  }
}

// Returns the pitch of a screw joint in metres per radian. <screw_thread_pitch> is in metres per
// turn. The older <thread_pitch> is in radians per metre, and of a left-handed thread (SDFormat
// 1.10).
double ThreadPitch(const sdf::Joint& source) {
  const sdf::ElementPtr element = source.Element();
  if (element != nullptr && element->HasElement("screw_thread_pitch")) {
    return element->Get<double>("screw_thread_pitch") / (2 * std::numbers::pi);
  }
  return -1 / source.ThreadPitch();
}

// Returns the joints that replace the joint: one for each axis.
std::vector<Joint> SplitByAxes(const sdf::Joint& source, const Joint& joint,
                               const std::string& place, const ReadingContext& context) {
  std::vector<Joint> row;
  if (source.Type() == sdf::JointType::BALL) {
    for (const geometry::Vector3& axis :
         {geometry::Vector3{0, 0, 1}, geometry::Vector3{0, 1, 0}, geometry::Vector3{1, 0, 0}}) {
      row.push_back(joint);
      row.back().kind = JointKind::kBall;
      row.back().axis = axis;
    }
    return row;
  }
  const bool has_two =
      source.Type() == sdf::JointType::UNIVERSAL || source.Type() == sdf::JointType::REVOLUTE2;
  for (unsigned i = 0; i < (has_two ? 2u : 1u); ++i) {
    row.push_back(joint);
    if (has_two) row.back().kind = JointKind::kRevolute;
    if (const sdf::JointAxis* axis = source.Axis(i)) {
      ReadAxis(*axis, place, context, row.back());
    } else if (has_two) {
      context.Warn(
          "the joint needs two axes, <axis> and <axis2>; the default is used for a missing one",
          place);
      row.back().axis = i == 0 ? geometry::Vector3{1, 0, 0} : geometry::Vector3{0, 1, 0};
    } else if (row.back().kind != JointKind::kFixed) {
      context.Warn("the joint has no <axis>; the z axis is used", place);
      row.back().axis = {0, 0, 1};
    }
  }
  return row;
}

int AddCross(const std::string& name, const Joint& joint, model::Model& model) {
  model::Link cross;
  cross.name = name;
  cross.model_from_link = joint.model_from_joint;
  cross.inertial.mass = 0;
  cross.inertial.ixx = cross.inertial.iyy = cross.inertial.izz = 0;
  model.links.push_back(std::move(cross));
  return static_cast<int>(model.links.size()) - 1;
}

JointKind KindOf(sdf::JointType type) {
  switch (type) {
    case sdf::JointType::REVOLUTE:
      return JointKind::kRevolute;
    case sdf::JointType::CONTINUOUS:
      return JointKind::kContinuous;
    case sdf::JointType::PRISMATIC:
      return JointKind::kPrismatic;
    case sdf::JointType::SCREW:
      return JointKind::kScrew;
    default:
      return JointKind::kFixed;
  }
}

}  // namespace

void AddJoint(const sdf::Joint& source, Joint joint, const std::string& place,
              const ReadingContext& context, model::Model& model) {
  joint.kind = KindOf(source.Type());
  if (joint.kind == JointKind::kScrew) {
    joint.thread_pitch = ThreadPitch(source);
    if (!std::isfinite(joint.thread_pitch)) {
      context.Warn("the pitch of a screw joint must not be 0; the joint is fixed", place);
      joint.kind = JointKind::kFixed;
      joint.thread_pitch = 0;
    }
  }
  std::vector<Joint> row = SplitByAxes(source, joint, place, context);
  for (std::size_t i = 0; i + 1 < row.size(); ++i) {
    const std::string suffix = i == 0 ? "" : std::to_string(i + 1);
    const int cross = AddCross(joint.name + "::cross" + suffix, joint, model);
    row[i].child = row[i + 1].parent = cross;
    row[i + 1].name = joint.name + "::axis" + std::to_string(i + 2);
  }
  for (Joint& each : row) model.joints.push_back(std::move(each));
}

}  // namespace gsv::formats
