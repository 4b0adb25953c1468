// The names of frames, by REP-105:
// - The world is "map".
// - The base of a robot is ROBOT/base_link, and its odometry frame is ROBOT/odom.
// - A moving link of a robot is ROBOT/LINK.
// - A sensor is ROBOT/SENSOR, and the frame of its images is ROBOT/SENSOR/optical.
// - A body that is not a robot is NAME, and its moving links are NAME/LINK.
#pragma once

#include <string>
#include <string_view>

namespace gsv::sensing {

inline constexpr std::string_view kWorldFrame = "map";
inline constexpr std::string_view kBaseFrame = "base_link";
inline constexpr std::string_view kOdometryFrame = "odom";
// The optical frame: z along the view, x to the right, y down.
inline constexpr std::string_view kOpticalFrame = "optical";

// Returns "BODY/PART".
inline std::string FrameOf(std::string_view body, std::string_view part) {
  return std::string(body).append("/").append(part);
}

}  // namespace gsv::sensing
