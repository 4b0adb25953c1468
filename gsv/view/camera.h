// The camera of a view: the parameters that users give, and its pose at an instant.
//
// Frames  eye and target are in the world. With `follow`, they are in the robot's frame without its
//         pitch and roll: x ahead, y left, z up.
// Units   metres, degrees, pixels.
// Errors  sentences that name the parameter and its limits (kInvalidArgument), or a missing robot
//         or camera (kNotFound).
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "gsv/base/error.h"
#include "gsv/rendering/lenses/camera_view.h"
#include "gsv/view/framing.h"

namespace gsv::view {

inline constexpr int kMinSide = 16;  // minimum width and height of an image, pixels
inline constexpr double kMinFieldOfView = 1, kMaxFieldOfView = 150;  // degrees

// The parameters of a view, as users give them.
struct Camera {
  int width = 1280, height = 720;  // size of the image, pixels
  // Position of the camera, and a point at the centre of the image. Not set: the default of the
  // view, or of the followed robot.
  std::optional<geometry::Vector3> eye, target;
  // Vertical angle in degrees. Default: 45, but the default view is 0.8 rad wide.
  std::optional<double> field_of_view;
  std::string follow;  // name of a robot; empty if the camera follows none
  // "ROBOT/CAMERA": use the view of this camera sensor; empty for none.
  std::string sensor;
  OverviewSide side;  // direction of the default view

  friend bool operator==(const Camera&, const Camera&) = default;
};

// Parses "1280x720". Each side is from kMinSide to rendering::kMaxImageSide.
base::Status SetSize(std::string_view text, Camera& camera);
// Checks each side of the image like SetSize().
base::Status CheckSize(int width, int height);
// Parses "1,2.5,-3": three numbers from -1e6 to 1e6. An error message contains `name`.
base::Result<geometry::Vector3> ParsePoint(std::string_view text, const std::string& name);
// Parses a finite number from kMinFieldOfView to kMaxFieldOfView.
base::Result<double> ParseFieldOfView(std::string_view text);
// Sets a part of Camera::side: "azimuth" and "elevation" (degrees), "zoom".
base::Status SetSide(const std::string& name, std::string_view text, OverviewSide& side);
// Fails if a parameter is invalid, or if parameters exclude each other. For example, eye and target
// need each other unless the camera follows a robot. A camera sensor excludes an eye, a target, a
// followed robot and a field of view.
base::Status Check(const Camera& camera);

// The view of a camera sensor at an instant.
struct SensorView {
  geometry::Pose world_from_sensor;
  double horizontal_fov = 0;  // rad
};

// Functions that find the parts of a scene which a camera may name.
struct SceneLookup {
  // Returns the pose of a body, or nullopt.
  std::function<std::optional<geometry::Pose>(const std::string& body)> pose;
  // Returns a camera of a robot. The error names the missing part.
  std::function<base::Result<SensorView>(const std::string& robot, const std::string& sensor)>
      sensor;
  // Returns the corners that the default view shows.
  std::function<std::vector<geometry::Vector3>()> corners;
};

// Checks the parameters, and returns the camera's view.
base::Result<rendering::CameraView> Place(const Camera& camera, const SceneLookup& lookup);

}  // namespace gsv::view
