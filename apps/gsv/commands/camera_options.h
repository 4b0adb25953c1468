// The options by which commands place the camera of an image.
#pragma once

#include <CLI/CLI.hpp>

#include "gsv/view/camera.h"

namespace gsv::app {

// Adds --size, --eye, --target, --follow, --camera and --fov. `camera` must outlive the command
// line.
void AddCameraOptions(CLI::App& command, view::Camera& camera);

// Prints the error and returns the exit code. If a recording, robot or camera is missing, the exit
// code is kInfrastructure. (PrintError() returns kBadModel in this case.)
int RefuseImage(const base::Error& error);

}  // namespace gsv::app
