#include "gsv/sensing/presets.h"

#include "gsv/base/spelling.h"

#include <algorithm>

#include <fmt/format.h>

namespace gsv::sensing {
namespace {

constexpr const char* kPreset = "preset";

// Radius (m), threshold and gain range of small 40 kHz transducers, which are 16 mm wide.
constexpr double kSmallTransducer = 0.008, kSmallThreshold = 0.12, kSmallGainRange = 1.5;

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
       "noise model of the VI-Sensor's ADIS16448 in the EuRoC MAV data sets (Burri and others "
       "2016, "
       "mav0/imu0/sensor.yaml); it states no bias instability",
       ImuParameters(1.6968e-4, 0, 1.9393e-5, 2.0e-3, 0, 3.0e-3)},
      {"imu", "mpu6050",
       "InvenSense's product specification PS-MPU-6000A-00, rev. 3.4, sections 6.1 and 6.2: "
       "gyroscope 0.005 deg/s per root hertz, accelerometer 400 ug per root hertz; it states no "
       "bias "
       "instability and no random walk",
       ImuParameters(8.727e-5, 0, 0, 3.923e-3, 0, 0)},
      {"lidar",
       "hokuyo_urg",
       "Hokuyo's SCIP 2.0 document C-42-03320B for the URG-04LX: steps 44 to 725 of 1024 a turn, "
       "step 384 ahead, 20 mm to 5.6 m (4.095 m with two-character data), 1 mm; beam of at most 40 "
       "mm at 4 m by the data sheet; noise of the beams at rest in a published arena log",
       {{"scan.horizontal.samples", 682.0},
        {"scan.horizontal.min_angle", -2.08621},
        {"scan.horizontal.max_angle", 2.09235},
        {"range.min", 0.02},
        {"range.max", 4.095},
        {"noise.stddev", 0.002},
        {"noise.precision", 0.001},
        {"range_noise", 0.0012},
        {"beam_divergence", 0.01}}},
      {"lidar",
       "rplidar_a2",
       "Slamtec's data sheet of the RPLIDAR A2M8, rev. 2.5: 8000 samples a second, 10 turns a "
       "second, up to 12 m; resolution 0.5 mm below 1.5 m and 1 % of the distance at most, taken "
       "as "
       "three standard deviations; minimum range of the similar A1M8",
       {{"scan.horizontal.samples", 800.0},
        {"range.min", 0.15},
        {"range.max", 12.0},
        {"noise.precision", 0.0005},
        {"range_noise", 0.0033}}},
      {"lidar",
       "sick_lms",
       "data sheet of the LMS 200: 180 deg, 1 deg, up to 81.83 m, 10 mm steps; noise and "
       "fractions of beams fitted to one half of a published log of a corridor",
       {{"scan.horizontal.samples", 180.0},
        {"scan.horizontal.min_angle", -1.562070},
        {"scan.horizontal.max_angle", 1.562070},
        {"range.min", 0.01},
        {"range.max", 81.83},
        {"noise.stddev", 0.006},
        {"noise.precision", 0.01},
        {"noise.dropout_probability", 0.012},
        {"range_noise", 0.0002},
        {"beam_divergence", 0.0044}}},
      {"odometry",
       "irobot_create",
       "fitted to robots 1 and 2 of data set 6 of UTIAS' multi-robot data sets "
       "(Leung and others 2011), driven by velocity commands; see docs/reality.md",
       {{"scale.linear", 1.038},
        {"scale.angular", 1.034},
        {"random.linear_per_metre", 0.073},
        {"random.angular_per_metre", 0.0847},
        {"random.angular_per_radian", 0.0807}}},
      {"ranging",
       "uwb_indoor",
       "fitted to one half of the log Indoor_UWB of libRSF (TU Chemnitz); see docs/reality.md",
       {{"max", 50.0},
        {"noise.mean", 0.0708},
        {"bias_per_metre", 0.0314},
        {"noise.stddev", 0.0853},
        {"range_noise", 0.0245}}},
      {"sonar",
       "hc_sr04",
       "fitted to one half of published beam tests of an HC-SR04, see docs/reality.md; range and "
       "resolution of its data sheet",
       {{"beam", std::string("cone")},
        {"min", 0.02},
        {"max", 4.0},
        {"field_of_view", 0.89},
        {"transducer_radius", kSmallTransducer},
        {"frequency", 40000.0},
        {"threshold", kSmallThreshold},
        {"gain_range", kSmallGainRange},
        {"specular_width", 0.05},
        {"target_size", true},
        {"second_reflections", true},
        {"noise.stddev", 0.002},
        {"noise.precision", 0.003}}},
      {"sonar",
       "mb1010",
       "MaxBotix' data sheet of the LV-MaxSonar-EZ1: 42 kHz, 6 to 254 inches in steps of one inch, "
       "transducer of 16.4 mm; its beam patterns are drawings without numbers, so threshold, "
       "gain_range and specular_width are those of hc_sr04",
       {{"beam", std::string("cone")},
        {"min", 0.1524},
        {"max", 6.45},
        {"transducer_radius", 0.0082},
        {"frequency", 42000.0},
        {"threshold", kSmallThreshold},
        {"gain_range", kSmallGainRange},
        {"specular_width", 0.05},
        {"target_size", true},
        {"second_reflections", true},
        {"noise.precision", 0.0254}}},
      {"sonar",
       "polaroid_6500",
       "SensComp's data sheets of the 6500 module and the 600 transducer: 49.4 kHz, 6 inches to 35 "
       "feet, a gain that grows with time; steps of 10 mm and noise of 1.2 mm as in a "
       "published log of a ring of sonars at rest",
       {{"beam", std::string("cone")},
        {"min", 0.15},
        {"max", 10.7},
        {"threshold", 0.02},
        {"target_size", true},
        {"second_reflections", true},
        {"noise.stddev", 0.0012},
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
                                : fmt::format("the presets are {}", fmt::join(names, ", "))) +
          base::DidYouMean(name != nullptr ? *name : "", names),
      fmt::format("{} {}", description.type, description.name));
}

}  // namespace gsv::sensing
