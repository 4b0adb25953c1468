#include "gsv/sensing/presets.h"

#include <algorithm>

#include <fmt/format.h>

namespace gsv::sensing {
namespace {

constexpr const char* kPreset = "preset";

model::Parameters ImuParameters(double gyro_density, double gyro_instability, double gyro_walk,
                                double accelerometer_density, double accelerometer_instability,
                                double accelerometer_walk) {
  return {{"angular_velocity.noise_density", gyro_density},
          {"angular_velocity.bias_instability", gyro_instability},
          {"angular_velocity.random_walk", gyro_walk},
          {"linear_acceleration.noise_density", accelerometer_density},
          {"linear_acceleration.bias_instability", accelerometer_instability},
          {"linear_acceleration.random_walk", accelerometer_walk}};
}

std::vector<Preset> MakePresets() {
  return {
      {"imu", "adis16448",
       "Analog Devices' data sheet (rev. E): gyroscope 0.0135 deg/s/rtHz and 14.5 deg/h, "
       "accelerometer 0.23 mg/rtHz and 0.25 mg; random walks of usual calibrations",
       ImuParameters(2.36e-4, 7.0e-5, 4.0e-6, 2.26e-3, 2.45e-3, 4.0e-5)},
      {"imu", "mpu6050",
       "InvenSense's data sheet (rev. 3.4): gyroscope 0.005 deg/s/rtHz, accelerometer 400 ug/rtHz; "
       "instabilities and random walks of usual Allan plots",
       ImuParameters(8.7e-5, 4.8e-5, 2.0e-5, 3.9e-3, 5.0e-4, 6.0e-5)},
      {"lidar",
       "hokuyo_urg",
       "data sheet of the URG-04LX: 682 beams over 240 deg, 10 Hz, 20 mm to 4.095 m, 1 mm steps, "
       "error below 10 mm up to 1 m and below 1 % beyond; a beam at rest scatters by 2 to 4 mm in "
       "a "
       "published arena log",
       {{"scan.horizontal.samples", 682.0},
        {"scan.horizontal.min_angle", -2.0944},
        {"scan.horizontal.max_angle", 2.0944},
        {"range.min", 0.02},
        {"range.max", 4.095},
        {"noise.stddev", 0.002},
        {"noise.precision", 0.001},
        {"range_noise", 0.0012},
        {"incidence_noise", 0.0005},
        {"beam_divergence", 0.006},
        {"reach", 5.5}}},
      {"lidar",
       "rplidar_a2",
       "Slamtec's data sheet of the RPLIDAR A2M8: 400 beams a turn, 0.15 to 12 m, resolution below "
       "1 % of the distance",
       {{"scan.horizontal.samples", 400.0},
        {"range.min", 0.15},
        {"range.max", 12.0},
        {"noise.stddev", 0.003},
        {"noise.precision", 0.0005},
        {"range_noise", 0.004},
        {"incidence_noise", 0.002},
        {"beam_divergence", 0.008},
        {"reach", 16.0}}},
      {"lidar",
       "sick_lms",
       "data sheet of the LMS 200: 180 deg, 1 deg, up to 81.83 m, 10 mm steps, error typically 5 "
       "mm "
       "up to 20 m; scatter and shares of beams fitted to one half of a published log of a "
       "corridor",
       {{"scan.horizontal.samples", 180.0},
        {"scan.horizontal.min_angle", -1.562070},
        {"scan.horizontal.max_angle", 1.562070},
        {"range.min", 0.01},
        {"range.max", 81.83},
        {"noise.stddev", 0.006},
        {"noise.precision", 0.01},
        {"noise.dropout_probability", 0.012},
        {"range_noise", 0.0002},
        {"beam_divergence", 0.0044},
        {"reach", 90.0}}},
      {"odometry",
       "irobot_create",
       "fitted to robots 1 and 2 of data set 6 of UTIAS' multi-robot data sets "
       "(Leung and others 2011), driven by velocity commands; see docs/reality.md",
       {{"scale.linear", 1.055},
        {"scale.angular", 1.056},
        {"random.linear_per_metre", 0.0735},
        {"random.angular_per_metre", 0.081},
        {"random.angular_per_radian", 0.085}}},
      {"sonar",
       "hc_sr04",
       "published beam tests of an HC-SR04 before a panel, a rule and a small sheet; range and "
       "step "
       "of its data sheet",
       {{"beam", std::string("cone")},
        {"min", 0.02},
        {"max", 4.0},
        {"field_of_view", 0.89},
        {"transducer_radius", 0.008},
        {"frequency", 40000.0},
        {"threshold", 0.14},
        {"gain_range", 1.55},
        {"specular_width", 0.05},
        {"target_size", true},
        {"second_reflections", true},
        {"noise.stddev", 0.002},
        {"noise.precision", 0.003}}},
      {"sonar",
       "mb1010",
       "MaxBotix' data sheet of the LV-MaxSonar-EZ1: 42 kHz, 6 to 254 inches in steps of one inch; "
       "a beam half as wide as that of the HC-SR04",
       {{"beam", std::string("cone")},
        {"min", 0.1524},
        {"max", 6.45},
        {"field_of_view", 0.6},
        {"transducer_radius", 0.008},
        {"frequency", 42000.0},
        {"threshold", 0.4},
        {"gain_range", 3.0},
        {"specular_width", 0.05},
        {"target_size", true},
        {"second_reflections", true},
        {"noise.precision", 0.0254}}},
      {"sonar",
       "polaroid_6500",
       "SensComp's data sheets of the 6500 module and the 600 transducer: 49.4 kHz, 6 inches to 35 "
       "feet, error 1 %",
       {{"beam", std::string("cone")},
        {"min", 0.15},
        {"max", 10.7},
        {"threshold", 0.02},
        {"gain_range", 6.0},
        {"target_size", true},
        {"second_reflections", true},
        {"noise.stddev", 0.005},
        {"noise.precision", 0.01}}},
  };
}

}  // namespace

const std::vector<Preset>& Presets() {
  static const std::vector<Preset> presets = MakePresets();
  return presets;
}

base::Result<model::SensorDescription> WithPreset(const std::string& type,
                                                  const model::SensorDescription& description) {
  const auto asked = description.parameters.find(kPreset);
  if (asked == description.parameters.end()) return description;
  const std::string* name = std::get_if<std::string>(&asked->second);
  std::vector<std::string> names;
  for (const Preset& preset : Presets()) {
    if (preset.type != type) continue;
    names.push_back(preset.name);
    if (name == nullptr || preset.name != *name) continue;
    model::SensorDescription whole = description;
    whole.parameters.insert(preset.parameters.begin(), preset.parameters.end());
    return whole;
  }
  return base::Fail(
      base::ErrorCode::kInvalidArgument,
      fmt::format("there is no preset \"{}\"; {}", name != nullptr ? *name : "(not a text)",
                  names.empty() ? "this type has none"
                                : fmt::format("the presets are {}", fmt::join(names, ", "))),
      fmt::format("{} {}", description.type, description.name));
}

}  // namespace gsv::sensing
