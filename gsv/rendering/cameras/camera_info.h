// How a camera's pictures are to be understood: ROS's sensor_msgs/CameraInfo of it.
//
// Frame   ROBOT/SENSOR/optical, as ROS wants it: z along the view, x to the right, y down.
// Lens    K holds fx, skew, cx; fy, cy in pixels, P is K beside a column of zeros, R is 1: what is
//         rectified has the same K. A distorted pinhole is "plumb_bob" with D = k1 k2 p1 p2 k3,
//         where the distortion is about the principal point; an equidistant wide lens is
//         "equidistant" with D = 0 0 0 0 and K for r = f a. For any other lens ROS has no model:
//         none is named, D is empty and K zero, which is ROS's "not calibrated".
#pragma once

#include <string>

#include "gsv/base/sim_time.h"
#include "gsv/rendering/lenses/lens.h"
#include "gsv/sensing/registry.h"

namespace gsv::rendering {

// Of the pinhole or the equidistant lens; zero, where ROS has no model of the lens.
struct LensModel {
  std::string name;  // ROS's distortion_model; empty: none
  std::vector<double> coefficients;
  Intrinsics intrinsics;
};
LensModel LensModelOf(const Lens& lens);

// For the sensor types of cameras.
sensing::Companion CameraInfoCompanion();
// The message, in CDR, of a camera in the frame `frame_id`.
sensing::Sensor::Bytes EncodeCameraInfo(const Lens& lens, base::SimTime time,
                                        const std::string& frame_id);

}  // namespace gsv::rendering
