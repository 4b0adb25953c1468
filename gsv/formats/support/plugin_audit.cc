#include "gsv/formats/support/plugin_audit.h"

#include <algorithm>
#include <initializer_list>

#include "gsv/base/spelling.h"
#include "gsv/formats/support/spelling.h"
#include "gsv/formats/support/support_table.h"

namespace gsv::formats {
namespace {

using tinyxml2::XMLElement;

// Parameters of drives and controllers, with the names of GSV or of Gazebo; see sdf_drive.cc.
constexpr std::string_view kParameters[] = {
    "left_joint",
    "right_joint",
    "leftJoint",
    "rightJoint",
    "left_front",
    "left_rear",
    "right_front",
    "right_rear",
    "leftFrontJoint",
    "leftRearJoint",
    "rightFrontJoint",
    "rightRearJoint",
    "front_left_joint",
    "front_right_joint",
    "back_left_joint",
    "back_right_joint",
    "left_steering_joint",
    "right_steering_joint",
    "steering_wheel_joint",
    "wheel_joint",
    "wheel_separation",
    "wheelSeparation",
    "wheel_diameter",
    "wheelDiameter",
    "wheel_radius",
    "wheelRadius",
    "left_wheel_radius",
    "right_wheel_radius",
    "wheel_base",
    "wheelbase",
    "steering_limit",
    "kingpin_width",
    "min_velocity",
    "max_velocity",
    "min_acceleration",
    "max_acceleration",
    "min_jerk",
    "max_jerk",
    "min_linear_velocity",
    "max_linear_velocity",
    "min_angular_velocity",
    "max_angular_velocity",
    "min_linear_acceleration",
    "max_linear_acceleration",
    "min_angular_acceleration",
    "max_angular_acceleration",
    "max_wheel_torque",
    "max_wheel_acceleration",
    "command_timeout",
    "joint_name",
    "initial_position",
    "initial_velocity",
    "use_velocity_commands",
    "use_force_commands",
    "cmd_max",
    "cmd_min",
    "cmd_offset",
    "p_gain",
    "i_gain",
    "d_gain",
    "i_max",
    "i_min",
    "controller",
    "wheel",
    "linear_velocity",
    "angular_velocity",
};

// Elements of models and parameters of sensors that GSV defines.
constexpr std::string_view kOurs[] = {
    "movement",
    "slip",
    "longitudinal",
    "lateral",
    "beam",
    "field_of_view",
    "transducer_radius",
    "threshold",
    "specular_width",
    "roughness",
    "dropout_probability",
    "latency",
    "outlier_probability",
    "outlier_stddev",
    "capacity",
    "initial_charge",
    "voltage_full",
    "voltage_empty",
    "resistance",
    "idle_current",
    "drive_charge",
    "opening",
    "closing_time",
    "left_jaw",
    "right_jaw",
    "counts_per_turn",
    "intensity",
    "brightness",
    "colour",
    "occlusion",
    "robots_only",
    "loudness",
    "path_loss_exponent",
    "wall_loss",
    "exposure",
    "exposure_time",
    "readout_time",
    "shutter_samples",
    "vignetting",
    "vertical_reference",
    "max_size",
};

template <std::size_t N>
std::string_view Misspelt(std::string_view written, const std::string_view (&known)[N]) {
  if (std::find(std::begin(known), std::end(known), written) != std::end(known)) return {};
  const auto meant = std::find_if(std::begin(known), std::end(known), [&](std::string_view name) {
    return base::LooksLike(written, name);
  });
  return meant == std::end(known) ? std::string_view() : *meant;
}

std::string_view TextOf(const char* text) { return text == nullptr ? std::string_view() : text; }

}  // namespace

std::vector<std::string> AboutPlugin(const XMLElement& plugin) {
  const std::string_view file = TextOf(plugin.Attribute("filename"));
  const std::string_view name = TextOf(plugin.Attribute("name"));
  const PluginSupport* known = SupportTable::Get().Plugin(file, name);
  std::vector<std::string> sentences;
  if (known == nullptr || known->support == Support::kNone) {
    sentences.push_back(
        "the plugin " + std::string(file.empty() ? name : file) + " is not supported: " +
        (known == nullptr
             ? "GSV loads no plugins of Gazebo. A behaviour or a plug-in of GSV can do its work"
             : std::string(known->note)));
  }
  if (known == nullptr || known->support != Support::kFull) return sentences;
  for (auto* child = plugin.FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement()) {
    const std::string_view meant = Misspelt(child->Name(), kParameters);
    if (meant.empty()) continue;
    sentences.push_back("the plugin " + std::string(file.empty() ? name : file) +
                        " has no parameter <" + child->Name() + ">; it is ignored. Did you mean <" +
                        std::string(meant) + ">?");
  }
  return sentences;
}

std::string AboutOurElement(std::string_view name) {
  constexpr std::string_view kPrefix = "gsv:";
  if (name.substr(0, kPrefix.size()) != kPrefix) return {};
  const std::string_view meant = Misspelt(name.substr(kPrefix.size()), kOurs);
  if (meant.empty()) return {};
  return "<" + std::string(name) +
         "> is not a GSV element; it is ignored. Did you mean <gsv:" + std::string(meant) + ">?";
}

}  // namespace gsv::formats
