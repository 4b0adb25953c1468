#include "gsv/formats/sdf/sdf_classic_control.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <vector>

#include "gsv/formats/sdf/sdf_document.h"
#include "gsv/formats/sdf/sdf_joint_target.h"

namespace gsv::formats {
namespace {

using model::JointTarget;

bool IsClassicControl(const sdf::Element& plugin) {
  return plugin.Get<std::string>("filename", "").first.find("JointControlPlugin") !=
         std::string::npos;
}

// Returns the numbers of an element if the element exists and has `count` numbers.
std::optional<std::vector<double>> NumbersOf(const sdf::ElementPtr& parent, const char* name,
                                             std::size_t count, const ReadingContext& context) {
  if (!parent->HasElement(name)) return std::nullopt;
  std::istringstream text(parent->Get<std::string>(name));
  std::vector<double> numbers(count);
  for (double& number : numbers) text >> number;
  const bool is_finite = std::all_of(numbers.begin(), numbers.end(),
                                     [](double number) { return std::isfinite(number); });
  if (text && is_finite) return numbers;
  context.Warn(std::string("<") + name + "> must hold " + std::to_string(count) +
                   (count == 1 ? " number" : " numbers") + ", not \"" +
                   parent->Get<std::string>(name) + "\"; it is ignored",
               PlaceOf(*parent->GetElement(name), context.source));
  return std::nullopt;
}

void ReadController(const sdf::ElementPtr& controller, const std::string& scope,
                    const ReadingContext& context, model::Model& model) {
  const std::string place = PlaceOf(*controller, context.source);
  if (!controller->HasElement("joint")) {
    context.Warn("the controller names no joint", place);
    return;
  }
  const std::string name = scope + controller->Get<std::string>("joint");
  model::Joint* const joint = FindControlledJoint(name, place, context, model);
  if (joint == nullptr) return;
  const auto type = controller->Get<std::string>("type", "").first;
  JointTarget target;
  target.joint = static_cast<int>(joint - model.joints.data());
  if (!type.empty() && type != "force" && type != "velocity" && type != "position") {
    context.Warn("@type of <controller> must be force, velocity or position, not \"" + type +
                     "\"; position is used",
                 place);
  }
  if (type == "force") target.kind = JointTarget::Kind::kEffort;
  if (type == "velocity") target.kind = JointTarget::Kind::kVelocity;
  if (const auto value = NumbersOf(controller, "target", 1, context)) target.value = (*value)[0];
  const auto gains = NumbersOf(controller, "pid_gains", 3, context);
  if (gains && target.kind != JointTarget::Kind::kEffort) {
    model::JointGains unlimited{(*gains)[0], (*gains)[1], (*gains)[2], {}, {}, 0};
    auto& of_kind =
        target.kind == JointTarget::Kind::kVelocity ? joint->velocity_gains : joint->position_gains;
    of_kind = WithoutNegatives(unlimited, place, context);
  }
  SetTarget(target, place, context, model);
}

}  // namespace

void ReadClassicControl(const sdf::ElementPtr& plugin, const std::string& scope,
                        const ReadingContext& context, model::Model& model) {
  if (!IsClassicControl(*plugin) || !plugin->HasElement("controller")) return;
  for (auto controller = plugin->GetElement("controller"); controller != nullptr;
       controller = controller->GetNextElement("controller")) {
    ReadController(controller, scope, context, model);
  }
}

}  // namespace gsv::formats
