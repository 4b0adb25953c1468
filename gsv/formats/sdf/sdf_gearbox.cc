#include "gsv/formats/sdf/sdf_gearbox.h"

#include <cmath>
#include <optional>

#include <sdf/Element.hh>
#include <sdf/JointAxis.hh>

namespace gsv::formats {
namespace {

using geometry::Vector3;
using model::Joint;

// A joint of the model, and the factor (1 or -1) from its angle to the gearbox's angle.
struct Shaft {
  int joint;
  double sign;
};

// Returns the direction of the axis in the model's frame. Returns a vector of length 0 if the file
// has none.
Vector3 AxisOf(const sdf::Joint& source, unsigned index, const Joint& gearbox) {
  const sdf::JointAxis* axis = source.Axis(index);
  ignition::math::Vector3d xyz;
  if (axis == nullptr || !axis->ResolveXyz(xyz).empty() || !(xyz.Length() > 0)) return {};
  return gearbox.model_from_joint.orientation * geometry::Normalized(FromIgnition(xyz));
}

std::optional<Shaft> FindShaft(const model::Model& model, int reference, int link,
                               const Vector3& axis) {
  constexpr double kParallel = 1 - 1e-6;
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const Joint& joint = model.joints[i];
    const bool hangs = joint.parent == reference && joint.child == link;
    const bool holds = joint.parent == link && joint.child == reference;
    if ((!hangs && !holds) || (joint.kind != model::JointKind::kRevolute &&
                               joint.kind != model::JointKind::kContinuous)) {
      continue;
    }
    const double along = Dot(joint.model_from_joint.orientation * joint.axis, axis);
    if (std::abs(along) < kParallel) continue;
    return Shaft{static_cast<int>(i), (along > 0) == hangs ? 1.0 : -1.0};
  }
  return std::nullopt;
}

}  // namespace

void CoupleGearbox(const sdf::Joint& source, const Joint& gearbox, int reference,
                   const std::string& place, const ReadingContext& context, model::Model& model) {
  const auto leave_out = [&](const std::string& why) {
    context.Warn("the gearbox \"" + gearbox.name + "\" " + why + "; it is left out", place);
  };
  const double ratio = source.Element()->Get<double>("gearbox_ratio", 1.0).first;
  if (!std::isfinite(ratio) || ratio == 0) {
    return leave_out("needs a finite <gearbox_ratio> other than 0");
  }
  if (reference < 0) {
    const auto body = source.Element()->Get<std::string>("gearbox_reference_body", "").first;
    return leave_out(body.empty() ? "has no <gearbox_reference_body>"
                                  : "names the <gearbox_reference_body> \"" + body +
                                        "\", which is not a link of the model");
  }
  const auto input = FindShaft(model, reference, gearbox.parent, AxisOf(source, 0, gearbox));
  const auto output = FindShaft(model, reference, gearbox.child, AxisOf(source, 1, gearbox));
  if (!input || !output || input->joint == output->joint) {
    return leave_out("needs a revolute joint about its axis between each link and its reference");
  }
  std::optional<model::Mimic>& mimic = model.joints[static_cast<std::size_t>(output->joint)].mimic;
  if (mimic) return leave_out("turns a joint that follows another one already");
  mimic = model::Mimic{input->joint, -ratio * input->sign * output->sign};
}

}  // namespace gsv::formats
