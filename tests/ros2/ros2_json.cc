#include "tests/ros2/ros2_json.h"

#include <cstddef>
#include <cstring>
#include <string>

namespace gsv::ros2_peer {
namespace {

// Converts infinities and NaN to strings, because JSON has no such numbers.
Json Number(double value) {
  if (value != value) return "nan";
  if (value - value != 0) return value > 0 ? "inf" : "-inf";
  return value;
}

Json Of(const builtin_interfaces_msg_dds__Time_& time) {
  return {{"sec", time.sec}, {"nanosec", time.nanosec}};
}
Json Of(const std_msgs_msg_dds__Header_& header) {
  return {{"stamp", Of(header.stamp)}, {"frame_id", header.frame_id}};
}
template <typename Vector>
Json OfVector(const Vector& v) {
  return {{"x", Number(v.x)}, {"y", Number(v.y)}, {"z", Number(v.z)}};
}
Json Of(const geometry_msgs_msg_dds__Quaternion_& q) {
  return {{"x", q.x}, {"y", q.y}, {"z", q.z}, {"w", q.w}};
}
Json Of(const geometry_msgs_msg_dds__Pose_& pose) {
  return {{"position", OfVector(pose.position)}, {"orientation", Of(pose.orientation)}};
}
Json Of(const geometry_msgs_msg_dds__TransformStamped_& each) {
  return {{"header", Of(each.header)},
          {"child_frame_id", each.child_frame_id},
          {"transform",
           {{"translation", OfVector(each.transform.translation)},
            {"rotation", Of(each.transform.rotation)}}}};
}
template <typename Value, std::size_t kSize>
Json List(const Value (&values)[kSize]) {
  Json list = Json::array();
  for (const Value value : values) list.push_back(Number(value));
  return list;
}
template <typename Sequence>
Json Numbers(const Sequence& values) {
  Json list = Json::array();
  for (std::uint32_t i = 0; i < values._length; ++i) list.push_back(Number(values._buffer[i]));
  return list;
}

float FloatAt(const std::uint8_t* bytes, std::size_t at) {
  float value = 0;
  std::memcpy(&value, bytes + at, sizeof value);
  return value;
}

// Returns the value in the middle of an image of 32FC1, or null for another encoding.
Json Centre(const sensor_msgs_msg_dds__Image_& image) {
  if (std::string(image.encoding) != "32FC1") return {};
  const std::size_t at = image.height / 2 * image.step + image.width / 2 * sizeof(float);
  if (at + sizeof(float) > image.data._length) return {};
  return Number(FloatAt(image.data._buffer, at));
}

// Returns the first three bytes.
template <typename Sequence>
Json First(const Sequence& data) {
  if (data._length < 3) return {};
  return Json::array({data._buffer[0], data._buffer[1], data._buffer[2]});
}

}  // namespace

Json ToJson(const rosgraph_msgs_msg_dds__Clock_& message) { return {{"clock", Of(message.clock)}}; }

Json ToJson(const std_msgs_msg_dds__String_& message) { return {{"data", message.data}}; }

Json ToJson(const std_msgs_msg_dds__Float64MultiArray_& message) {
  const auto& data = message.data;
  return {{"data", std::vector<double>(data._buffer, data._buffer + data._length)}};
}

Json ToJson(const geometry_msgs_msg_dds__PoseStamped_& message) {
  return {{"header", Of(message.header)}, {"pose", Of(message.pose)}};
}

Json ToJson(const geometry_msgs_msg_dds__Twist_& message) {
  return {{"linear", OfVector(message.linear)}, {"angular", OfVector(message.angular)}};
}

Json ToJson(const geometry_msgs_msg_dds__TwistStamped_& message) {
  return {{"header", Of(message.header)}, {"twist", ToJson(message.twist)}};
}

Json ToJson(const tf2_msgs_msg_dds__TFMessage_& message) {
  Json transforms = Json::array();
  for (std::uint32_t i = 0; i < message.transforms._length; ++i) {
    transforms.push_back(Of(message.transforms._buffer[i]));
  }
  return {{"transforms", transforms}};
}

Json ToJson(const nav_msgs_msg_dds__Odometry_& message) {
  return {
      {"header", Of(message.header)},
      {"child_frame_id", message.child_frame_id},
      {"pose", {{"pose", Of(message.pose.pose)}, {"covariance", List(message.pose.covariance)}}},
      {"twist",
       {{"twist", ToJson(message.twist.twist)}, {"covariance", List(message.twist.covariance)}}}};
}

Json ToJson(const sensor_msgs_msg_dds__LaserScan_& message) {
  return {{"header", Of(message.header)},
          {"angle_min", message.angle_min},
          {"angle_max", message.angle_max},
          {"angle_increment", message.angle_increment},
          {"time_increment", message.time_increment},
          {"scan_time", message.scan_time},
          {"range_min", message.range_min},
          {"range_max", message.range_max},
          {"ranges", Numbers(message.ranges)},
          {"intensities", Numbers(message.intensities)}};
}

Json ToJson(const sensor_msgs_msg_dds__Range_& message) {
  return {{"header", Of(message.header)},           {"radiation_type", message.radiation_type},
          {"field_of_view", message.field_of_view}, {"min_range", message.min_range},
          {"max_range", message.max_range},         {"range", Number(message.range)}};
}

Json ToJson(const sensor_msgs_msg_dds__Imu_& message) {
  return {{"header", Of(message.header)},
          {"orientation", Of(message.orientation)},
          {"orientation_covariance", List(message.orientation_covariance)},
          {"angular_velocity", OfVector(message.angular_velocity)},
          {"angular_velocity_covariance", List(message.angular_velocity_covariance)},
          {"linear_acceleration", OfVector(message.linear_acceleration)},
          {"linear_acceleration_covariance", List(message.linear_acceleration_covariance)}};
}

Json ToJson(const sensor_msgs_msg_dds__JointState_& message) {
  Json names = Json::array();
  for (std::uint32_t i = 0; i < message.name._length; ++i) names.push_back(message.name._buffer[i]);
  return {{"header", Of(message.header)},
          {"name", names},
          {"position", Numbers(message.position)},
          {"velocity", Numbers(message.velocity)},
          {"effort", Numbers(message.effort)}};
}

Json ToJson(const sensor_msgs_msg_dds__Image_& message) {
  return {{"header", Of(message.header)},
          {"height", message.height},
          {"width", message.width},
          {"encoding", message.encoding},
          {"is_bigendian", message.is_bigendian},
          {"step", message.step},
          {"data", {{"bytes", message.data._length}}},
          {"first", First(message.data)},
          {"centre", Centre(message)}};
}

Json ToJson(const sensor_msgs_msg_dds__CompressedImage_& message) {
  return {{"header", Of(message.header)},
          {"format", message.format},
          {"data", {{"bytes", message.data._length}}},
          {"first", First(message.data)}};
}

Json ToJson(const sensor_msgs_msg_dds__PointCloud2_& message) {
  Json fields = Json::array(), points = Json::array();
  for (std::uint32_t i = 0; i < message.fields._length; ++i) {
    const auto& field = message.fields._buffer[i];
    fields.push_back({field.name, field.offset, field.datatype, field.count});
  }
  for (std::size_t at = 0; message.point_step >= 12 && at + 12 <= message.data._length;
       at += message.point_step) {
    const std::uint8_t* const bytes = message.data._buffer;
    points.push_back({Number(FloatAt(bytes, at)), Number(FloatAt(bytes, at + 4)),
                      Number(FloatAt(bytes, at + 8))});
  }
  return {{"header", Of(message.header)},
          {"height", message.height},
          {"width", message.width},
          {"fields", fields},
          {"is_bigendian", message.is_bigendian},
          {"point_step", message.point_step},
          {"row_step", message.row_step},
          {"data", {{"bytes", message.data._length}}},
          {"points", points},
          {"is_dense", message.is_dense}};
}

Json ToJson(const sensor_msgs_msg_dds__NavSatFix_& message) {
  return {{"header", Of(message.header)},
          {"status", static_cast<int>(message.status.status)},
          {"service", message.status.service},
          {"latitude", message.latitude},
          {"longitude", message.longitude},
          {"altitude", message.altitude},
          {"position_covariance", List(message.position_covariance)},
          {"position_covariance_type", message.position_covariance_type}};
}

Json ToJson(const sensor_msgs_msg_dds__MagneticField_& message) {
  return {{"header", Of(message.header)},
          {"magnetic_field", OfVector(message.magnetic_field)},
          {"magnetic_field_covariance", List(message.magnetic_field_covariance)}};
}

Json ToJson(const sensor_msgs_msg_dds__BatteryState_& message) {
  return {{"header", Of(message.header)},
          {"voltage", Number(message.voltage)},
          {"temperature", Number(message.temperature)},
          {"current", Number(message.current)},
          {"charge", Number(message.charge)},
          {"capacity", Number(message.capacity)},
          {"design_capacity", Number(message.design_capacity)},
          {"percentage", Number(message.percentage)},
          {"power_supply_status", message.power_supply_status},
          {"power_supply_health", message.power_supply_health},
          {"power_supply_technology", message.power_supply_technology},
          {"present", message.present},
          {"cell_voltage", Numbers(message.cell_voltage)},
          {"cell_temperature", Numbers(message.cell_temperature)},
          {"location", message.location},
          {"serial_number", message.serial_number}};
}

Json ToJson(const geometry_msgs_msg_dds__WrenchStamped_& message) {
  return {{"header", Of(message.header)},
          {"force", OfVector(message.wrench.force)},
          {"torque", OfVector(message.wrench.torque)}};
}

Json ToJson(const gsv_msgs_msg_dds__Bumper_& message) {
  Json contacts = Json::array();
  for (std::uint32_t i = 0; i < message.contacts._length; ++i) {
    const auto& contact = message.contacts._buffer[i];
    contacts.push_back({{"other", contact.other},
                        {"point", OfVector(contact.point)},
                        {"normal", OfVector(contact.normal)},
                        {"depth", contact.depth},
                        {"closing_speed", contact.closing_speed},
                        {"force", OfVector(contact.force)}});
  }
  return {{"header", Of(message.header)}, {"contacts", contacts}};
}

Json ToJson(const diagnostic_msgs_msg_dds__DiagnosticArray_& message) {
  Json all = Json::array();
  for (std::uint32_t i = 0; i < message.status._length; ++i) {
    const auto& status = message.status._buffer[i];
    Json values = Json::object();
    for (std::uint32_t v = 0; v < status.values._length; ++v) {
      values[status.values._buffer[v].key] = status.values._buffer[v].value;
    }
    all.push_back({{"level", status.level},
                   {"name", status.name},
                   {"message", status.message},
                   {"hardware_id", status.hardware_id},
                   {"values", values}});
  }
  return {{"header", Of(message.header)}, {"status", all}};
}

Json ToJson(const sensor_msgs_msg_dds__CameraInfo_& message) {
  return {
      {"header", Of(message.header)},
      {"height", message.height},
      {"width", message.width},
      {"distortion_model", message.distortion_model},
      {"d", Numbers(message.d)},
      {"k", List(message.k)},
      {"r", List(message.r)},
      {"p", List(message.p)},
      {"binning", {message.binning_x, message.binning_y}},
      {"roi", {message.roi.x_offset, message.roi.y_offset, message.roi.height, message.roi.width}},
      {"do_rectify", message.roi.do_rectify}};
}

Json ToJson(const rcl_interfaces_msg_dds__Log_& message) {
  return {{"stamp", Of(message.stamp)}, {"level", message.level}, {"name", message.name},
          {"msg", message.msg},         {"file", message.file},   {"function", message.function},
          {"line", message.line}};
}

}  // namespace gsv::ros2_peer
