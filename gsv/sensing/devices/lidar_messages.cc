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

// in bytes: 4 each for x, y and z, 2 for the ring, and 2 of padding
constexpr std::uint32_t kPointSize = 16;
constexpr std::uint32_t kRingOffset = 12;
constexpr std::uint32_t kIntensityOffset = 16;  // a point with an intensity has 20 bytes

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

void Write(const LidarSettings& settings, const readings::Lidar& measured,
           messages::sensor_msgs::LaserScan& scan) {
  WriteFan(settings, measured.ranges, scan);
  scan.intensities.reserve(measured.intensities.size());
  for (const double intensity : measured.intensities) {
    scan.intensities.push_back(static_cast<float>(intensity));
  }
}

void Write(const LidarSettings& settings, const readings::Lidar& measured,
           messages::gsv_msgs::LidarScan& scan) {
  WriteFan(settings, measured.ranges, scan);
  const Angles& vertical = settings.vertical;
  scan.beams = static_cast<std::uint32_t>(settings.horizontal.count);
  scan.vertical_angle_min = static_cast<float>(vertical.first);
  scan.vertical_angle_max = static_cast<float>(vertical.angle(vertical.count - 1));
  scan.vertical_angle_increment = static_cast<float>(vertical.increment());
  scan.rows = static_cast<std::uint32_t>(vertical.count);
}

PointCloud2 PointsOf(std::span<const Vector3> directions, int rows, std::span<const double> ranges,
                     std::span<const double> intensities) {
  PointCloud2 cloud;
  const char* const names[] = {"x", "y", "z"};
  for (std::uint32_t i = 0; i < 3; ++i) {
    cloud.fields.push_back({names[i], 4 * i, PointField::kFloat32, 1});
  }
  cloud.fields.push_back({"ring", kRingOffset, PointField::kUint16, 1});
  const bool has_intensities = !intensities.empty() && intensities.size() == ranges.size();
  if (has_intensities) {
    cloud.fields.push_back({"intensity", kIntensityOffset, PointField::kFloat32, 1});
  }
  const std::size_t beams = directions.size() / static_cast<std::size_t>(rows);
  cloud.point_step = has_intensities ? kIntensityOffset + 4 : kPointSize;
  cloud.width = static_cast<std::uint32_t>(beams);
  cloud.height = static_cast<std::uint32_t>(rows);
  cloud.row_step = cloud.point_step * cloud.width;
  cloud.data.resize(cloud.point_step * directions.size());
  for (std::size_t i = 0; i < std::min(directions.size(), ranges.size()); ++i) {
    const double range =
        std::isfinite(ranges[i]) ? ranges[i] : std::numeric_limits<double>::quiet_NaN();
    const Vector3 point = range * directions[i];
    const float xyz[] = {static_cast<float>(point.x), static_cast<float>(point.y),
                         static_cast<float>(point.z)};
    const auto ring = static_cast<std::uint16_t>(i / beams);
    std::uint8_t* const data = &cloud.data[cloud.point_step * i];
    std::memcpy(data, xyz, sizeof xyz);
    std::memcpy(data + kRingOffset, &ring, sizeof ring);
    if (has_intensities) {
      const auto intensity = static_cast<float>(intensities[i]);
      std::memcpy(data + kIntensityOffset, &intensity, sizeof intensity);
    }
  }
  return cloud;
}

}  // namespace gsv::sensing
