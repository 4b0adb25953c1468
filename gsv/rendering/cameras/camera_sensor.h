// The sensor types "camera" and "wideangle_camera": images from a robot's viewpoint.
//
// Frame       sensor frame: x along the view, y left, z up.
// Parameters  the parameters of every camera (see optics.h), of shutter.h and of exposure.h. The
//             default lens of a "wideangle_camera" is stereographic.
// Readings    values {width, height} in pixels; the image is RGB. As a message:
//             sensor_msgs/CompressedImage, JPEG of quality 80.
// Errors      Sample(): kUnavailable with the reason if there is no renderer. Sensors
//             that are not cameras work without a renderer.
#pragma once

#include <memory>

#include "gsv/rendering/renderer.h"
#include "gsv/sensing/registry.h"

namespace gsv::rendering {

// `renderer` is the result of Renderer::Start(), which may be a failure. Fails if the registry
// already has a camera type.
[[nodiscard]] base::Status AddCameraSensor(sensing::SensorRegistry& registry,
                                           base::Result<std::shared_ptr<Renderer>> renderer);

}  // namespace gsv::rendering
