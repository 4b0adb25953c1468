// Encodes images directly into the bytes of sensor_msgs/msg/Image. No message object is made, which
// would be another copy of the pixels.
#pragma once

#include <span>
#include <string>

#include "gsv/base/sim_time.h"
#include "gsv/messages/cdr.h"
#include "gsv/model/image.h"

namespace gsv::ros2 {

inline constexpr const char* kImageType = "sensor_msgs/msg/Image";

// Encodes an image as rgb8 or rgba8, without its pixels. The caller appends the pixels to complete
// the message.
void EncodeImageHead(const model::Image& image, base::SimTime time, const std::string& frame,
                     messages::Bytes& out);
// Encodes a depth image as 32FC1, in metres: rows from the top, width × height values.
void EncodeDepth(int width, int height, std::span<const double> depth, base::SimTime time,
                 const std::string& frame, messages::Bytes& out);

}  // namespace gsv::ros2
