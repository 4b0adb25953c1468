#include "gsv/formats/sdf/sdf_joint_target.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <vector>

#include "gsv/base/spelling.h"
#include "gsv/formats/sdf/sdf_document.h"

namespace gsv::formats {
namespace {

using model::Joint;
using model::JointTarget;

// Returns the text in lower case, without "-" and "_".
std::string Plain(const std::string& text) {
  std::string plain;
  for (const char c : text) {
    if (c != '-' && c != '_')
      plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return plain;
}

std::optional<JointTarget::Kind> KindOf(const sdf::Element& plugin) {
  for (const char* attribute : {"filename", "name"}) {
    const std::string text = Plain(plugin.Get<std::string>(attribute, "").first);
    if (text.find("jointpositioncontroller") != std::string::npos) {
      return JointTarget::Kind::kPosition;
    }
    if (text.find("jointcontroller") != std::string::npos) return JointTarget::Kind::kVelocity;
  }
  return std::nullopt;
}

class TargetReader {
 public:
  TargetReader(sdf::ElementPtr plugin, const ReadingContext& context)
      : plugin_(std::move(plugin)), context_(context) {}

  std::string Place() const { return PlaceOf(*plugin_, context_.source); }

  double Number(const char* name, double otherwise) const {
    if (!plugin_->HasElement(name)) return otherwise;
    const auto text = plugin_->Get<std::string>(name);
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (end != text.c_str() && std::isfinite(value)) return value;
    context_.Warn(
        std::string("<") + name + "> must be a number, not \"" + text + "\"; its default is used",
        PlaceOf(*plugin_->GetElement(name), context_.source));
    return otherwise;
  }

  // Sets the gains and limits of a joint's controller. The defaults are Gazebo's.
  void SetUp(JointTarget::Kind kind, Joint& joint) const {
    if (kind == JointTarget::Kind::kVelocity) {
      if (Flag("use_force_commands")) joint.velocity_gains = GainsOf({1, 0, 0});
      return;
    }
    const double most = Number("cmd_max", -1);
    if (Flag("use_velocity_commands")) {
      if (most > 0) joint.velocity_limit = std::min(joint.velocity_limit, most);
    } else if (plugin_->HasElement("p_gain") || plugin_->HasElement("i_gain") ||
               plugin_->HasElement("d_gain")) {
      joint.position_gains = GainsOf({1, 0.1, 0.01});
    } else if (most > 0) {
      joint.effort_limit = std::min(joint.effort_limit, most);
    }
  }

 private:
  bool Flag(const char* name) const {
    if (!plugin_->HasElement(name)) return false;
    const auto text = plugin_->Get<std::string>(name);
    return text != "false" && text != "0";
  }

  model::JointGains GainsOf(model::JointGains gains) const {
    const auto take = [&](const char* name, double& value) { value = Number(name, value); };
    take("p_gain", gains.p), take("i_gain", gains.i), take("d_gain", gains.d);
    take("i_min", gains.integral.min), take("i_max", gains.integral.max);
    take("cmd_min", gains.effort.min), take("cmd_max", gains.effort.max);
    take("cmd_offset", gains.offset);
    return WithoutNegatives(gains, Place(), context_);
  }

  sdf::ElementPtr plugin_;
  const ReadingContext& context_;
};

}  // namespace

model::JointGains WithoutNegatives(model::JointGains gains, const std::string& place,
                                   const ReadingContext& context) {
  for (double* gain : {&gains.p, &gains.i, &gains.d}) {
    if (*gain >= 0 && std::isfinite(*gain)) continue;
    context.Warn("the gains of a controller must not be negative; 0 is used", place);
    *gain = 0;
  }
  return gains;
}

model::Joint* FindControlledJoint(const std::string& name, const std::string& place,
                                  const ReadingContext& context, model::Model& model) {
  std::vector<std::string> names;
  for (Joint& joint : model.joints) {
    if (joint.name != name) {
      names.push_back(joint.name);
      continue;
    }
    if (model::TakesCommands(joint.kind)) return &joint;
    context.Warn("the controller names the joint \"" + name + "\", whose type takes no commands; " +
                     "the controller is ignored",
                 place);
    return nullptr;
  }
  const bool closes_loop = std::any_of(model.loop_joints.begin(), model.loop_joints.end(),
                                       [&](const Joint& joint) { return joint.name == name; });
  context.Warn("the controller names the joint \"" + name + "\", " +
                   (closes_loop ? "which closes a loop and takes no commands; name another joint "
                                  "of the loop"
                                : "which the model does not have" + base::DidYouMean(name, names)),
               place);
  return nullptr;
}

void SetTarget(const JointTarget& target, const std::string& place, const ReadingContext& context,
               model::Model& model) {
  const auto earlier = std::erase_if(
      model.joint_targets, [&](const JointTarget& each) { return each.joint == target.joint; });
  if (earlier > 0) {
    context.Warn("the joint \"" + model.joints[static_cast<std::size_t>(target.joint)].name +
                     "\" has several controllers; the target of the last one is used",
                 place);
  }
  model.joint_targets.push_back(target);
}

void ReadJointTargets(const sdf::ElementPtr& plugin, const std::string& scope,
                      const ReadingContext& context, model::Model& model) {
  const auto kind = KindOf(*plugin);
  if (!kind) return;
  const TargetReader reader(plugin, context);
  const bool is_position = *kind == JointTarget::Kind::kPosition;
  const double value = reader.Number(is_position ? "initial_position" : "initial_velocity", 0);
  if (!plugin->HasElement("joint_name")) {
    context.Warn("the controller names no joint", reader.Place());
    return;
  }
  // A joint with several axes was split into one joint for each axis (AddJoint()). <joint_index>
  // selects the axis.
  const double axis_index = reader.Number("joint_index", 0);
  const std::string axis =
      axis_index > 0 ? "::axis" + std::to_string(static_cast<int>(std::min(axis_index, 99.0)) + 1)
                     : "";
  for (auto element = plugin->GetElement("joint_name"); element != nullptr;
       element = element->GetNextElement("joint_name")) {
    const std::string place = PlaceOf(*element, context.source);
    const std::string name = scope + element->Get<std::string>() + axis;
    Joint* const joint = FindControlledJoint(name, place, context, model);
    if (joint == nullptr) continue;
    reader.SetUp(*kind, *joint);
    const int index = static_cast<int>(joint - model.joints.data());
    SetTarget({index, *kind, value}, place, context, model);
  }
}

}  // namespace gsv::formats
