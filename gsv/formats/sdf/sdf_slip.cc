#include "gsv/formats/sdf/sdf_slip.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "gsv/base/spelling.h"
#include "gsv/formats/sdf/sdf_document.h"

namespace gsv::formats {
namespace {

bool IsWheelSlip(const sdf::Element& plugin) {
  for (const char* attribute : {"filename", "name"}) {
    std::string text;
    for (const char c : plugin.Get<std::string>(attribute, "").first) {
      if (c != '-' && c != '_') {
        text += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      }
    }
    if (text.find("lookupwheelslip") != std::string::npos) return false;
    if (text.find("wheelslip") != std::string::npos) return true;
  }
  return false;
}

// Returns a number that is at least 0. For any other value, adds a warning and returns `otherwise`.
double NumberOf(const sdf::ElementPtr& parent, const char* name, double otherwise,
                const ReadingContext& context) {
  if (!parent->HasElement(name)) return otherwise;
  const auto text = parent->Get<std::string>(name);
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (end != text.c_str() && value >= 0 && std::isfinite(value)) return value;
  context.Warn(std::string("<") + name + "> must be a number of at least 0, not \"" + text + "\"",
               PlaceOf(*parent->GetElement(name), context.source));
  return otherwise;
}

// Reports a <gsv:slip> without effect, and elements and text in it that are ignored.
void CheckSlip(const sdf::ElementPtr& slip, const ReadingContext& context) {
  const std::string place = PlaceOf(*slip, context.source);
  bool is_empty = true;
  for (auto child = slip->GetFirstElement(); child != nullptr; child = child->GetNextElement()) {
    const std::string& name = child->GetName();
    is_empty = false;
    if (name == "longitudinal" || name == "lateral") {
      context.Warn("<" + name + "> in <gsv:slip> is ignored. Did you mean <gsv:" + name + ">?",
                   PlaceOf(*child, context.source));
    } else if (name == "gsv:longitudinal" || name == "gsv:lateral") {
      continue;
    } else {
      context.Warn("<" + name + "> is not an element of <gsv:slip>; it is ignored",
                   PlaceOf(*child, context.source));
    }
  }
  if (!is_empty) return;
  const auto text = slip->GetValue() == nullptr ? std::string() : slip->GetValue()->GetAsString();
  context.Warn("<gsv:slip> must contain <gsv:longitudinal> or <gsv:lateral>" +
                   (text.empty() ? std::string() : ", not \"" + text + "\"") + "; it is ignored",
               place);
}

double RadiusOfWheel(const model::Link& link) {
  for (const model::Collision& collision : link.collisions) {
    if (const auto* cylinder = std::get_if<geometry::Cylinder>(&collision.shape)) {
      return cylinder->radius;
    }
    if (const auto* sphere = std::get_if<geometry::Sphere>(&collision.shape)) return sphere->radius;
  }
  return 0;
}

}  // namespace

void ReadWheelSlip(const sdf::ElementPtr& plugin, const std::string& scope,
                   const ReadingContext& context, model::Model& model) {
  if (!IsWheelSlip(*plugin)) return;
  if (!plugin->HasElement("wheel")) {
    context.Warn("the wheel slip has no <wheel link_name=\"…\">; no wheel slips",
                 PlaceOf(*plugin, context.source));
    return;
  }
  std::vector<std::string> names;
  for (const model::Link& link : model.links) names.push_back(link.name);
  for (auto wheel = plugin->GetElement("wheel"); wheel != nullptr;
       wheel = wheel->GetNextElement("wheel")) {
    const std::string place = PlaceOf(*wheel, context.source);
    const auto written = wheel->Get<std::string>("link_name", "").first;
    if (written.empty()) {
      context.Warn("<wheel> has no link_name; it is ignored", place);
      continue;
    }
    const std::string name = scope + written;
    const auto link = std::find_if(model.links.begin(), model.links.end(),
                                   [&](const model::Link& each) { return each.name == name; });
    if (link == model.links.end()) {
      context.Warn("the wheel slip names the link \"" + name + "\", which the model does not have" +
                       base::DidYouMean(name, names),
                   place);
      continue;
    }
    model::SlippingWheel slipping;
    const std::size_t problems_before = context.problems.size();
    slipping.slip.lateral = NumberOf(wheel, "slip_compliance_lateral", 0, context);
    slipping.slip.longitudinal = NumberOf(wheel, "slip_compliance_longitudinal", 0, context);
    slipping.normal_force = NumberOf(wheel, "wheel_normal_force", 0, context);
    slipping.radius = NumberOf(wheel, "wheel_radius", RadiusOfWheel(*link), context);
    if (!(slipping.normal_force > 0) || !(slipping.radius > 0)) {
      if (context.problems.size() > problems_before) continue;  // a bad value was reported
      context.Warn("the slip of \"" + name + "\" needs a " +
                       (slipping.radius > 0 ? "<wheel_normal_force>" : "<wheel_radius>") +
                       " above 0; it does not slip",
                   place);
      continue;
    }
    link->wheel = slipping;
  }
}

model::Slip ReadSlip(const sdf::ElementPtr& parent, const ReadingContext& context) {
  if (parent == nullptr || !parent->HasElement("gsv:slip")) return {};
  const sdf::ElementPtr slip = parent->GetElement("gsv:slip");
  CheckSlip(slip, context);
  return {NumberOf(slip, "gsv:longitudinal", 0, context),
          NumberOf(slip, "gsv:lateral", 0, context)};
}

}  // namespace gsv::formats
