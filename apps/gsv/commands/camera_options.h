// The options by which commands place the camera of an image.
#pragma once

#include <CLI/CLI.hpp>

#include "gsv/view/camera.h"

namespace gsv::app {

// Adds --size, --eye, --target, --follow, --camera and --fov. `camera` must outlive the command
// line.
void AddCameraOptions(CLI::App& command, view::Camera& camera);

// Prints the error and returns its exit code. A missing recording, robot or camera has the exit
// code of a missing file, and not the exit code of a bad model.
int RefuseImage(const base::Error& error);

}  // namespace gsv::app
