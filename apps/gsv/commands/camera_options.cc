#include "apps/gsv/commands/camera_options.h"

#include <string>

#include "apps/gsv/process/exit_code.h"

namespace gsv::app {
namespace {

// Returns the value of the result. If the result is an error, throws an exception of CLI11, which
// prints the option's name and the error.
template <typename T>
T OrInvalidOption(base::Result<T> result, const char* option) {
  if (!result) throw CLI::ValidationError(option, result.error().Sentence());
  return *std::move(result);
}

}  // namespace

int RefuseImage(const base::Error& error) {
  const int code = PrintError(error);
  return error.code == base::ErrorCode::kNotFound ? kInfrastructure : code;
}

void AddCameraOptions(CLI::App& command, view::Camera& camera) {
  command
      .add_option_function<std::string>(
          "--size",
          [&camera](const std::string& text) {
            if (auto set = view::SetSize(text, camera); !set) {
              throw CLI::ValidationError("--size", set.error().Sentence());
            }
          },
          "size of the image in pixels (default: 1280x720)")
      ->type_name("WIDTHxHEIGHT");
  command
      .add_option_function<std::string>(
          "--eye",
          [&camera](const std::string& text) {
            camera.eye = OrInvalidOption(view::ParsePoint(text, "the eye"), "--eye");
          },
          "position of the camera in metres; with --follow, in the robot's frame\n"
          "Without --follow, give both --eye and --target.")
      ->type_name("X,Y,Z");
  command
      .add_option_function<std::string>(
          "--target",
          [&camera](const std::string& text) {
            camera.target = OrInvalidOption(view::ParsePoint(text, "the target"), "--target");
          },
          "point at the image centre (default: ahead of the followed robot, or the whole "
          "world)\n"
          "The point has the unit and the frame of --eye.")
      ->type_name("X,Y,Z");
  command.add_option("--follow", camera.follow, "robot that the camera follows")
      ->type_name("ROBOT");
  command
      .add_option("--camera", camera.sensor,
                  "robot's camera from which to draw, without noise and distortion")
      ->type_name("ROBOT/CAMERA");
  command
      .add_option_function<std::string>(
          "--fov",
          [&camera](const std::string& text) {
            camera.field_of_view = OrInvalidOption(view::ParseFieldOfView(text), "--fov");
          },
          "vertical field of view (default: 45)")
      ->type_name("DEGREES");
}

}  // namespace gsv::app
