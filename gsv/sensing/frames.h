// The names of frames, by REP-105. The world is "map". A robot's base is ROBOT/base_link, its
// odometry frame ROBOT/odom. A moving link is ROBOT/LINK, a sensor ROBOT/SENSOR, the frame of its
// images ROBOT/SENSOR/optical. Another body is NAME, its moving links NAME/LINK.
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
