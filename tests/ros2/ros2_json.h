// Converts samples that Cyclone DDS decoded to JSON with the names of the fields.
#pragma once

#include <nlohmann/json.hpp>

#include "ros2_types.h"

namespace gsv::ros2_peer {

using Json = nlohmann::ordered_json;

Json ToJson(const rosgraph_msgs_msg_dds__Clock_& message);
Json ToJson(const std_msgs_msg_dds__String_& message);
Json ToJson(const std_msgs_msg_dds__Float64MultiArray_& message);
Json ToJson(const geometry_msgs_msg_dds__PoseStamped_& message);
Json ToJson(const geometry_msgs_msg_dds__Twist_& message);
Json ToJson(const geometry_msgs_msg_dds__TwistStamped_& message);
Json ToJson(const tf2_msgs_msg_dds__TFMessage_& message);
Json ToJson(const nav_msgs_msg_dds__Odometry_& message);
Json ToJson(const sensor_msgs_msg_dds__LaserScan_& message);
Json ToJson(const sensor_msgs_msg_dds__Range_& message);
Json ToJson(const sensor_msgs_msg_dds__Imu_& message);
Json ToJson(const sensor_msgs_msg_dds__JointState_& message);
Json ToJson(const sensor_msgs_msg_dds__CameraInfo_& message);
Json ToJson(const sensor_msgs_msg_dds__CompressedImage_& message);
// Adds the points as lists of x, y and z. These must be the first fields.
Json ToJson(const sensor_msgs_msg_dds__PointCloud2_& message);
Json ToJson(const sensor_msgs_msg_dds__NavSatFix_& message);
Json ToJson(const sensor_msgs_msg_dds__MagneticField_& message);
Json ToJson(const sensor_msgs_msg_dds__BatteryState_& message);
Json ToJson(const geometry_msgs_msg_dds__WrenchStamped_& message);
Json ToJson(const gsv_msgs_msg_dds__Bumper_& message);
Json ToJson(const diagnostic_msgs_msg_dds__DiagnosticArray_& message);
// Converts the pixels to {"bytes": their number}, with the first three bytes.
Json ToJson(const sensor_msgs_msg_dds__Image_& message);
Json ToJson(const rcl_interfaces_msg_dds__Log_& message);

}  // namespace gsv::ros2_peer
