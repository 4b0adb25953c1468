#include "gsv/formats/sdf/sdf_sensor.h"

#include <cstdlib>
#include <set>
#include <string>
#include <string_view>

#include <sdf/Param.hh>

#include "gsv/model/collision_names.h"

namespace gsv::formats {
namespace {

using model::Parameters;
using model::ParameterValue;

// The prefix of GSV's own elements, such as <gsv:dropout>.
constexpr std::string_view kOurs = "gsv:";
constexpr const char* kPreset = "gsv:preset";

bool IsWrapper(const std::string& name) {
  static const std::set<std::string> wrappers = {
      "air_pressure", "air_speed", "altimeter", "camera",         "contact",      "force_torque",
      "gps",          "imu",       "lidar",     "logical_camera", "magnetometer", "navsat",
      "ray",          "rfid",      "rfidtag",   "sonar",          "transceiver"};
  return wrappers.count(name) != 0;
}

bool IsNoParameter(const std::string& name, const sdf::Element& parent) {
  return name == "pose" || name == "update_rate" || name == "visualize" || name == "plugin" ||
         (name == "frame" && parent.GetName() != "force_torque");
}

ParameterValue FromText(const std::string& text) {
  if (text == "true") return true;
  if (text == "false") return false;
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  if (!text.empty() && *end == '\0') return number;
  return text;
}

ParameterValue ValueOf(sdf::Param& param, bool defined_by_sdformat) {
  const std::string& type = param.GetTypeName();
  bool flag = false;
  double number = 0;
  if (type == "bool" && param.Get(flag)) return flag;
  if (type != "string" && type != "bool" && param.Get(number) &&
      type.find("::") == std::string::npos && type.find("vector") == std::string::npos &&
      type != "pose" && type != "color") {
    return number;
  }
  const std::string text = param.GetAsString();
  return defined_by_sdformat ? ParameterValue(text) : FromText(text);
}

// Whether SDFormat defines the element: its parent's description has it.
bool IsDefined(const sdf::Element& element) {
  const sdf::ElementPtr parent = element.GetParent();
  return parent != nullptr && parent->HasElementDescription(element.GetName());
}

// Whether libsdformat has added the element, with its default value.
bool IsDefault(const sdf::Element& element) {
  return IsDefined(element) && element.GetValue() != nullptr && !element.GetValue()->GetSet();
}

// Adds a parameter. If an element is repeated, the first one counts. But all <collision> names of a
// contact sensor are joined.
void AddParameter(const std::string& path, ParameterValue value, Parameters& parameters) {
  const auto [known, is_new] = parameters.emplace(path, value);
  if (is_new || path != model::kCollisionNames) return;
  auto* const names = std::get_if<std::string>(&known->second);
  const auto* const name = std::get_if<std::string>(&value);
  if (names != nullptr && name != nullptr) *names += "\n" + *name;
}

// Adds the parameters below `element`. If `only_given` is true, skips elements that are not in the
// file but that libsdformat has added with their default values.
void Flatten(const sdf::ElementPtr& element, const std::string& prefix, bool only_given,
             Parameters& parameters) {
  for (auto child = element->GetFirstElement(); child != nullptr; child = child->GetNextElement()) {
    std::string name = child->GetName();
    if (name.starts_with(kOurs)) name.erase(0, kOurs.size());
    if (IsNoParameter(name, *element)) continue;
    const std::string path = prefix.empty() ? name : prefix + "." + name;
    const bool wraps = prefix.empty() && IsWrapper(name);
    const std::string inner = wraps ? "" : path;
    // libsdformat gives each <lens> without a <type> a stereographic lens. The default type depends on
    // the type of the sensor (docs/sensors.md).
    const bool is_left_out = (only_given || path == "lens.type") && IsDefault(*child);
    if (child->GetFirstElement() == nullptr && child->GetValue() != nullptr && !is_left_out) {
      AddParameter(path, ValueOf(*child->GetValue(), IsDefined(*child)), parameters);
    }
    for (const auto& attribute : child->GetAttributes()) {
      if (!attribute->GetSet() || (wraps && attribute->GetKey() == "name")) continue;
      parameters.emplace((inner.empty() ? "" : inner + ".") + attribute->GetKey(),
                         ValueOf(*attribute, true));
    }
    Flatten(child, inner, only_given, parameters);
  }
}

}  // namespace

model::SensorDescription ReadSensor(const sdf::ElementPtr& sensor) {
  model::SensorDescription description;
  description.name = sensor->Get<std::string>("name");
  description.type = sensor->Get<std::string>("type");
  description.update_rate = sensor->Get<double>("update_rate", 0.0).first;
  description.visualize = sensor->Get<bool>("visualize", false).first;
  // If there is a preset, only the parameters in the file are read, because the preset provides the
  // other parameters.
  Flatten(sensor, "", sensor->HasElement(kPreset), description.parameters);
  return description;
}

}  // namespace gsv::formats
