// The parameters that all cameras have in common.
#pragma once

#include "gsv/base/error.h"
#include "gsv/rendering/camera_view.h"
#include "gsv/sensing/parameters.h"

namespace gsv::rendering {

// horizontal_fov (rad, 1.047), image.width and image.height (pixels, 320 by 240, at most 4096),
// clip.near and clip.far (m, 0.1 and 100). Refuses by the reader.
CameraParameters ReadCameraParameters(sensing::ParameterReader& reader);

}  // namespace gsv::rendering
