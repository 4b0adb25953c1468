#include "gsv/sensing/devices/lidar_messages.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace gsv::sensing {
namespace {

using geometry::Vector3;
using messages::sensor_msgs::PointCloud2;
using messages::sensor_msgs::PointField;

constexpr std::uint32_t kPointSize = 16;  // bytes: x, y, z, ring, two of padding
constexpr std::uint32_t kRingOffset = 12;

template <typename Scan>
void WriteFan(const LidarSettings& settings, std::span<const double> ranges, Scan& scan) {
  const Angles& fan = settings.horizontal;
  scan.angle_min = static_cast<float>(fan.first);
  scan.angle_max = static_cast<float>(fan.angle(fan.count - 1));
  scan.angle_increment = static_cast<float>(fan.increment());
  scan.range_min = static_cast<float>(settings.min);
  scan.range_max = static_cast<float>(settings.max);
  scan.ranges.reserve(ranges.size());
  for (const double range : ranges) scan.ranges.push_back(static_cast<float>(range));
}

}  // namespace

void Write(const LidarSettings& settings, std::span<const double> ranges,
           messages::sensor_msgs::LaserScan& scan) {
  WriteFan(settings, ranges, scan);
}

void Write(const LidarSettings& settings, std::span<const double> ranges,
           messages::gsv_msgs::LidarScan& scan) {
  WriteFan(settings, ranges, scan);
  const Angles& vertical = settings.vertical;
  scan.beams = static_cast<std::uint32_t>(settings.horizontal.count);
  scan.vertical_angle_min = static_cast<float>(vertical.first);
  scan.vertical_angle_max = static_cast<float>(vertical.angle(vertical.count - 1));
  scan.vertical_angle_increment = static_cast<float>(vertical.increment());
  scan.rows = static_cast<std::uint32_t>(vertical.count);
}

PointCloud2 PointsOf(std::span<const Vector3> directions, int rows,
                     std::span<const double> ranges) {
  PointCloud2 cloud;
  const char* const names[] = {"x", "y", "z"};
  for (std::uint32_t i = 0; i < 3; ++i) {
    cloud.fields.push_back({names[i], 4 * i, PointField::kFloat32, 1});
  }
  cloud.fields.push_back({"ring", kRingOffset, PointField::kUint16, 1});
  const std::size_t beams = directions.size() / static_cast<std::size_t>(rows);
  cloud.point_step = kPointSize;
  cloud.width = static_cast<std::uint32_t>(beams);
  cloud.height = static_cast<std::uint32_t>(rows);
  cloud.row_step = kPointSize * cloud.width;
  cloud.data.resize(kPointSize * directions.size());
  for (std::size_t i = 0; i < std::min(directions.size(), ranges.size()); ++i) {
    const double range =
        std::isfinite(ranges[i]) ? ranges[i] : std::numeric_limits<double>::quiet_NaN();
    const Vector3 point = range * directions[i];
    const float xyz[] = {static_cast<float>(point.x), static_cast<float>(point.y),
                         static_cast<float>(point.z)};
    const auto ring = static_cast<std::uint16_t>(i / beams);
    std::memcpy(&cloud.data[kPointSize * i], xyz, sizeof xyz);
    std::memcpy(&cloud.data[kPointSize * i + kRingOffset], &ring, sizeof ring);
  }
  return cloud;
}

}  // namespace gsv::sensing
