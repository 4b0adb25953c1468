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

// GSV's own elements of worlds and models, and the parameters of its sensors (docs/sensors.md,
// docs/actuators.md, docs/people.md).
constexpr std::string_view kOurs[] = {
    "ambient",
    "anchor",
    "angle",
    "angular",
    "angular_per_metre",
    "angular_per_radian",
    "aspect_ratio",
    "beam",
    "beam_divergence",
    "bias_instability",
    "bias_mean",
    "bias_per_metre",
    "bias_stddev",
    "brightness",
    "capacity",
    "capture_ratio",
    "clip",
    "closing_time",
    "collision",
    "colour",
    "counts_per_turn",
    "current",
    "distortion",
    "drive_charge",
    "dropout_probability",
    "dynamic_bias_correlation_time",
    "dynamic_bias_stddev",
    "enable_orientation",
    "essid",
    "exposure",
    "exposure_time",
    "fading",
    "far",
    "field_of_view",
    "firing_slot",
    "force",
    "frame",
    "frequency",
    "gain",
    "gain_range",
    "goal",
    "ground",
    "height",
    "horizontal_fov",
    "idle_current",
    "image",
    "inbox",
    "incidence_noise",
    "initial_charge",
    "intensity",
    "intensity_range",
    "intensity_scale",
    "joint",
    "latency",
    "lateral",
    "left_jaw",
    "lens",
    "linear",
    "linear_per_metre",
    "longitudinal",
    "loss_probability",
    "loudness",
    "max",
    "max_size",
    "max_walls",
    "mean",
    "measure_direction",
    "min",
    "movement",
    "near",
    "noise",
    "noise_density",
    "occlusion",
    "opening",
    "orientation",
    "outlier_probability",
    "outlier_stddev",
    "path_loss_exponent",
    "pedestrians",
    "position",
    "power",
    "precision",
    "preset",
    "radius",
    "random",
    "random_walk",
    "range",
    "range_noise",
    "reach",
    "readout_time",
    "resistance",
    "resolution",
    "right_jaw",
    "robots_only",
    "roughness",
    "scale",
    "second_reflections",
    "sensitivity",
    "short_probability",
    "short_range",
    "shutter_samples",
    "slip",
    "specular_width",
    "speed",
    "speed_deviation",
    "stddev",
    "target_size",
    "threshold",
    "torque",
    "transducer_radius",
    "type",
    "velocity",
    "vertical_reference",
    "vignetting",
    "voltage",
    "voltage_empty",
    "voltage_full",
    "wall_delay",
    "wall_loss",
    "wall_noise",
    "width",
    "z",
};

// The types of docs/sensors.md and docs/actuators.md that SDFormat does not define, with their
// further names.
constexpr std::string_view kOurSensorTypes[] = {
    "positioning",
    "odometry",
    "wheel_odometry",
    "gnss",
    "bumper",
    "forcetorque",
    "joint_encoders",
    "joint_state",
    "battery",
    "radio",
    "transceiver",
    "wireless_transceiver",
    "ranging",
    "microphone",
    "gripper",
    "lamp",
    "led",
    "speaker",
    "buzzer",
    "wideangle_camera",
    "wide_angle_camera",
    "normals_camera",
    "normals",
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
    const std::string named(file.empty() ? name : file);
    sentences.push_back(
        (named.empty() ? "a <plugin> without @filename" : "the plugin " + named) +
        " is not supported: " +
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

bool IsOurSensorType(std::string_view type) {
  return std::find(std::begin(kOurSensorTypes), std::end(kOurSensorTypes), type) !=
         std::end(kOurSensorTypes);
}

std::string AboutOurElement(std::string_view name, bool is_of_plugin) {
  constexpr std::string_view kPrefix = "gsv:";
  if (name.substr(0, kPrefix.size()) != kPrefix) return {};
  const std::string_view plain = name.substr(kPrefix.size());
  if (std::find(std::begin(kOurs), std::end(kOurs), plain) != std::end(kOurs)) return {};
  const std::string_view meant = Misspelt(plain, kOurs);
  if (meant.empty() && is_of_plugin) return {};
  const std::string sentence = "<" + std::string(name) + "> is not a GSV element; it is ignored.";
  return meant.empty() ? sentence : sentence + " Did you mean <gsv:" + std::string(meant) + ">?";
}

}  // namespace gsv::formats
