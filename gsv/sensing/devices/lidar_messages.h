// Converts a lidar's scan to messages. The caller sets the headers and scan_time.
#pragma once

#include <span>

#include "gsv/geometry/vector3.h"
#include "gsv/messages/gsv_msgs.h"
#include "gsv/messages/sensor_msgs.h"
#include "gsv/readings/catalogue.h"
#include "gsv/sensing/devices/lidar_settings.h"

namespace gsv::sensing {

// Writes a scan. Values are in rows, from the lowest row. LidarScan has no intensities, because
// they are in the point cloud.
void Write(const LidarSettings& settings, const readings::Lidar& measured,
           messages::sensor_msgs::LaserScan& scan);
void Write(const LidarSettings& settings, const readings::Lidar& measured,
           messages::gsv_msgs::LidarScan& scan);

// Returns one point for each beam, in the sensor's frame, ordered by rows. The points of beams
// without a measurement are NaN. The fields are x, y, z in m as float32, and ring as uint16, which
// is the row counted from the lowest. With `intensities` there is another field, intensity, as
// float32. `directions` and `ranges` have equal sizes; directions are unit vectors.
messages::sensor_msgs::PointCloud2 PointsOf(std::span<const geometry::Vector3> directions, int rows,
                                            std::span<const double> ranges,
                                            std::span<const double> intensities = {});

}  // namespace gsv::sensing
