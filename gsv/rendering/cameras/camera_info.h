// Makes ROS's sensor_msgs/CameraInfo of a camera.
//
// Frame   ROBOT/SENSOR/optical, as in ROS: z along the view, x to the right, y down.
// Lens    K contains fx, skew, cx; fy, cy in pixels. P is K with a column of zeros. R is the
//         identity, so a rectified image has the same K. A pinhole with distortion is "plumb_bob"
//         with D = k1 k2 p1 p2 k3; its distortion must be about the principal point. An equidistant
//         wide lens is "equidistant" with D = 0 0 0 0 and the K of r = f a (r: distance from the
//         centre in px, a: angle from the axis). ROS has no model of other lenses. For them, the
//         name and D are empty, and K is zero, which means "not calibrated" in ROS.
#pragma once

#include <string>

#include "gsv/base/sim_time.h"
#include "gsv/rendering/lenses/lens.h"
#include "gsv/sensing/registry.h"

namespace gsv::rendering {

// The parameters of a pinhole or an equidistant lens; zero if ROS has no model of the lens.
struct LensModel {
  std::string name;                  // ROS's distortion_model; empty if ROS has none for the lens
  std::vector<double> coefficients;  // the distortion D
  Intrinsics intrinsics;             // the elements of K
};
// Returns the ROS parameters of a lens.
LensModel LensModelOf(const Lens& lens);

// Returns the companion message of camera types: sensor_msgs/CameraInfo, sent with each reading.
sensing::Companion CameraInfoCompanion();
// Encodes the message in CDR, for a camera whose frame is `frame_id`.
sensing::Sensor::Bytes EncodeCameraInfo(const Lens& lens, base::SimTime time,
                                        const std::string& frame_id);

}  // namespace gsv::rendering
