#include "gsv/view/camera.h"

#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <vector>

#include "gsv/view/framing.h"

namespace gsv::view {
namespace {

using base::ErrorCode;
using base::Fail;
using geometry::Pose;
using geometry::Vector3;

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kDefaultFieldOfView = 45;  // degrees
constexpr double kNear = 0.05, kFar = 5000;
// A camera with a field of view (degrees) below kTelephoto has its far plane at kTelephotoFar. The
// map of the viewer needs this: its field of view is 1 degree. So its camera is 53 times as far
// away as a camera that shows the same area in another view.
constexpr double kTelephoto = 10, kTelephotoFar = 1e6;
constexpr double kMaxCoordinate = 1e6;
// The default eye and target for a followed robot, in its level frame, m: the camera is behind the
// robot and above it.
constexpr Vector3 kEyeBehind{-3, 0, 2}, kTargetAhead{0.5, 0, 0.3};

std::optional<double> NumberOf(std::string_view text) {
  double value = 0;
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_whole = parsed.ec == std::errc() && parsed.ptr == text.data() + text.size();
  return is_whole && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

// Returns the horizontal angle of view for a vertical one, rad.
double HorizontalOf(double vertical, int width, int height) {
  return 2 * std::atan(std::tan(vertical / 2) * width / height);
}

Pose Looking(const Vector3& eye, const Vector3& target) {
  const Vector3 ahead = target - eye;
  const double level = std::hypot(ahead.x, ahead.y);
  return {eye, geometry::FromRollPitchYaw(
                   {0, std::atan2(-ahead.z, level), std::atan2(ahead.y, ahead.x)})};
}

rendering::CameraParameters ParametersOf(const Camera& camera) {
  rendering::CameraParameters parameters;
  parameters.width = camera.width;
  parameters.height = camera.height;
  const double vertical = camera.field_of_view.value_or(kDefaultFieldOfView);
  parameters.horizontal_fov = HorizontalOf(vertical * kDegree, camera.width, camera.height);
  parameters.near = kNear;
  parameters.far = vertical < kTelephoto ? kTelephotoFar : kFar;
  return parameters;
}

base::Result<rendering::CameraView> Following(const Camera& camera, const SceneLookup& lookup) {
  const auto pose = lookup.pose(camera.follow);
  if (!pose) return Fail(ErrorCode::kNotFound, "there is no robot '" + camera.follow + "'");
  const Pose level{pose->position,
                   geometry::FromRollPitchYaw({0, 0, geometry::Yaw(pose->orientation)})};
  return rendering::CameraView{Looking(level * camera.eye.value_or(kEyeBehind),
                                       level * camera.target.value_or(kTargetAhead)),
                               ParametersOf(camera)};
}

base::Result<rendering::CameraView> OfSensor(const Camera& camera, const SceneLookup& lookup) {
  const std::size_t slash = camera.sensor.rfind('/');
  const auto found = lookup.sensor(camera.sensor.substr(0, slash), camera.sensor.substr(slash + 1));
  if (!found) return Fail(found.error());
  rendering::CameraView view{found->world_from_sensor, ParametersOf(camera)};
  constexpr double kMaxViewAngle = 3;  // maximum angle of view of a pinhole camera, rad
  view.parameters.horizontal_fov = std::min(found->horizontal_fov, kMaxViewAngle);
  return view;
}

}  // namespace

base::Status CheckSize(int width, int height) {
  const auto fits = [](int side) { return side >= kMinSide && side <= rendering::kMaxImageSide; };
  if (fits(width) && fits(height)) return {};
  return Fail(ErrorCode::kInvalidArgument,
              "the size of the image is " + std::to_string(width) + "x" + std::to_string(height) +
                  ", but each side must have " + std::to_string(kMinSide) + " to " +
                  std::to_string(rendering::kMaxImageSide) + " pixels");
}

base::Status SetSize(std::string_view text, Camera& camera) {
  int width = 0, height = 0;
  const char* const end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, width);
  const bool has_second = first.ec == std::errc() && first.ptr != end && *first.ptr == 'x';
  const auto second = std::from_chars(has_second ? first.ptr + 1 : end, end, height);
  if (!has_second || second.ec != std::errc() || second.ptr != end) {
    return Fail(ErrorCode::kInvalidArgument,
                "the size of the image must be WIDTHxHEIGHT, such as "
                "1280x720, but it is '" +
                    std::string(text.substr(0, 64)) + "'");
  }
  if (auto fits = CheckSize(width, height); !fits) return fits;
  camera.width = width;
  camera.height = height;
  return {};
}

base::Result<Vector3> ParsePoint(std::string_view text, const std::string& name) {
  std::array<double, 3> values{};
  std::string_view rest = text;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t end = i + 1 < values.size() ? rest.find(',') : rest.size();
    const auto value = end == std::string_view::npos ? std::nullopt : NumberOf(rest.substr(0, end));
    if (!value || std::abs(*value) > kMaxCoordinate) {
      return Fail(ErrorCode::kInvalidArgument,
                  name + " must be three numbers in metres, such as 1,2.5,3, but it is '" +
                      std::string(text.substr(0, 64)) + "'");
    }
    values[i] = *value;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return Vector3{values[0], values[1], values[2]};
}

base::Result<double> ParseFieldOfView(std::string_view text) {
  const auto value = NumberOf(text);
  if (value && *value >= kMinFieldOfView && *value <= kMaxFieldOfView) return *value;
  return Fail(ErrorCode::kInvalidArgument,
              "the field of view must be 1 to 150 degrees, but it is '" +
                  std::string(text.substr(0, 64)) + "'");
}

base::Status SetSide(const std::string& name, std::string_view text, OverviewSide& side) {
  const auto value = NumberOf(text);
  const auto set = [&](double& target, double low, double high, double unit,
                       const char* limits) -> base::Status {
    if (value && *value >= low && *value <= high) {
      target = *value * unit;
      return {};
    }
    return Fail(ErrorCode::kInvalidArgument, "the parameter " + name + " must be " + limits +
                                                 ", but it is '" + std::string(text.substr(0, 64)) +
                                                 "'");
  };
  if (name == "azimuth") return set(side.azimuth, -360, 360, kDegree, "-360 to 360 degrees");
  if (name == "elevation") return set(side.elevation, -90, 90, kDegree, "-90 to 90 degrees");
  return set(side.zoom, 0.1, 100, 1, "0.1 to 100");
}

base::Status Check(const Camera& camera) {
  if (auto fits = CheckSize(camera.width, camera.height); !fits) return fits;
  const bool has_place = camera.eye || camera.target || !camera.follow.empty();
  if ((has_place || !camera.sensor.empty()) && camera.side != OverviewSide{}) {
    return Fail(ErrorCode::kInvalidArgument,
                "azimuth, elevation and zoom cannot be combined with eye, target, follow or "
                "camera; use the parameters of one group only");
  }
  if (!camera.sensor.empty()) {
    if (has_place || camera.field_of_view) {
      return Fail(ErrorCode::kInvalidArgument,
                  "the camera of a robot has its own pose and field of view; leave out eye, "
                  "target, follow and fov");
    }
    const std::size_t slash = camera.sensor.rfind('/');
    if (slash == std::string::npos || slash == 0 || slash + 1 == camera.sensor.size()) {
      return Fail(ErrorCode::kInvalidArgument,
                  "the camera must be ROBOT/CAMERA, such as pebble/camera, but it is '" +
                      camera.sensor.substr(0, 64) + "'");
    }
    return {};
  }
  if (camera.follow.empty() && camera.eye.has_value() != camera.target.has_value()) {
    return Fail(ErrorCode::kInvalidArgument,
                "the pose of the camera needs both eye and target, in metres");
  }
  if (camera.eye && camera.target && Norm(*camera.eye - *camera.target) < 1e-6) {
    return Fail(ErrorCode::kInvalidArgument, "eye and target must be different points");
  }
  return {};
}

base::Result<rendering::CameraView> Place(const Camera& camera, const SceneLookup& lookup) {
  if (auto ok = Check(camera); !ok) return Fail(ok.error());
  if (!camera.sensor.empty()) return OfSensor(camera, lookup);
  if (!camera.follow.empty()) return Following(camera, lookup);
  if (camera.eye) {
    return rendering::CameraView{Looking(*camera.eye, *camera.target), ParametersOf(camera)};
  }
  rendering::CameraView all = Overview(lookup.corners(), camera.width, camera.height, camera.side);
  if (camera.field_of_view) all.parameters.horizontal_fov = ParametersOf(camera).horizontal_fov;
  return all;
}

}  // namespace gsv::view
