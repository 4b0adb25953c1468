// The sensor type "logical_camera": the models in view, without an image.
//
// Frame       sensor frame: x along the view, y left, z up.
// Parameters  near and far (m, 0.05 and 10), horizontal_fov (rad, 1.047), aspect_ratio (width over
//             height, 1.333), occlusion (true: leaves out hidden models), robots_only (false).
// Readings    for each model whose centre is in view, by name, the values {x, y, z (m), roll,
//             pitch, yaw (rad)} of its frame and the label of its name. The centre is that of the
//             box around its collisions; a model of planes alone is never in view. As a message:
//             vision_msgs/Detection3DArray.
#pragma once

#include "gsv/sensing/registry.h"

namespace gsv::sensing {

SensorType LogicalCameraType();

}  // namespace gsv::sensing
