#include "gsv/dynamics/motion/wheel_slip.h"

#include <algorithm>

namespace gsv::dynamics {
namespace {

std::optional<model::SlippingWheel> SlippingWheelOf(const model::Model& model,
                                                    const Articulation& articulation,
                                                    const Part& part, double gravity) {
  for (const int link : part.links) {
    if (const auto& wheel = model.links[static_cast<std::size_t>(link)].wheel) return *wheel;
  }
  if (!model.drive) return std::nullopt;
  const model::Drive& drive = *model.drive;
  const auto turns = [&](const std::vector<int>& joints) {
    return std::find(joints.begin(), joints.end(), part.joint) != joints.end();
  };
  if (!turns(drive.left_wheels) && !turns(drive.right_wheels)) return std::nullopt;
  const std::size_t count = drive.left_wheels.size() + drive.right_wheels.size();
  const double weight = articulation.mass * gravity;
  return model::SlippingWheel{drive.slip, weight / static_cast<double>(count), drive.wheel_radius};
}

}  // namespace

std::optional<RollingWheel> WheelOf(const model::Model& model, const Articulation& articulation,
                                    const Part& part, double gravity) {
  if (part.joint < 0) return std::nullopt;
  const auto wheel = SlippingWheelOf(model, articulation, part, gravity);
  if (!wheel || !(wheel->normal_force > 0) || !(wheel->radius > 0)) return std::nullopt;
  const model::Joint& joint = model.joints[static_cast<std::size_t>(part.joint)];
  const geometry::Vector3 axle =
      Inverse(part.model_from_part.orientation) * (joint.model_from_joint.orientation * joint.axis);
  return RollingWheel{*wheel, axle};
}

}  // namespace gsv::dynamics
