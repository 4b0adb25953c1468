// The sensor type "camera": pictures from a robot's own viewpoint.
//
// Frame       sensor frame: x along the view, y left, z up.
// Parameters  horizontal_fov (rad, 1.047), image.width and image.height (pixels, 320 by 240, at
//             most 4096), clip.near and clip.far (m, 0.1 and 100).
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
