// The sensor types "camera" and "wideangle_camera": pictures from a robot's own viewpoint.
//
// Frame       sensor frame: x along the view, y left, z up.
// Parameters  those of every camera, see optics.h (a "wideangle_camera" has a stereographic lens),
//             and those of shutter.h and exposure.h.
// Readings    values {width, height} in pixels; the picture is RGB. As a message:
//             sensor_msgs/CompressedImage, JPEG of quality 80.
// Errors      Sample(): kUnavailable with the reason where there is no renderer; everything that
//             is not a camera works without one.
#pragma once

#include <memory>

#include "gsv/rendering/renderer.h"
#include "gsv/sensing/registry.h"

namespace gsv::rendering {

// `renderer` is what Renderer::Start() gave, its failure included. Fails if the registry has a
// camera already.
[[nodiscard]] base::Status AddCameraSensor(sensing::SensorRegistry& registry,
                                           base::Result<std::shared_ptr<Renderer>> renderer);

}  // namespace gsv::rendering
