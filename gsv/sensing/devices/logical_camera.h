// The sensor type "logical_camera": the models in view, without an image.
//
// Frame       sensor frame: x along the view, y left, z up.
// Parameters  (with their default values)
//   near (0.05 m), far (10 m)   limits of the distance along the view
//   horizontal_fov (1.047 rad)
//   aspect_ratio (4/3)      width divided by height
//   occlusion (true)        leaves out models that are hidden behind other models
//   robots_only (false)     leaves out models that are not robots
// Readings    for each model whose centre is in view, ordered by name: the values {x, y, z (m),
//             roll, pitch, yaw (rad)} of the model's frame, and its name as label. The centre is
//             the centre of the box around the model's collisions. A model that consists of planes
//             only is never in view. As a message: vision_msgs/Detection3DArray.
#pragma once

#include "gsv/sensing/registry.h"

namespace gsv::sensing {

SensorType LogicalCameraType();

}  // namespace gsv::sensing
