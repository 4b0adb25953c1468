#include "gsv/ros2/sensor_source.h"

#include <algorithm>
#include <utility>

#include "gsv/base/log.h"
#include "gsv/base/named.h"
#include "gsv/messages/geometry_msgs.h"
#include "gsv/messages/nav_msgs.h"
#include "gsv/messages/sensor_msgs.h"
#include "gsv/readings/catalogue.h"
#include "gsv/ros2/image_message.h"
#include "gsv/ros2/names.h"
#include "gsv/sensing/encoding.h"
#include "gsv/sensing/frames.h"

namespace gsv::ros2 {
namespace {

using sensing::Reading;

// The usual topic and the usual rate of ROS 2 drivers for a type of sensor.
struct UsualTopic {
  const char* topic;
  bool is_sensor_data;
  double rate;  // Hz; used if the sensor has no rate
};

constexpr double kUsualRate = 20;
constexpr double kUsualImageRate = 15;

const UsualTopic* FindUsualTopic(const std::string& type) {
  static constexpr base::Named<UsualTopic> kUsualTopics[] = {
      {readings::Lidar::kType, {"scan", true, 10}},
      {readings::Odometry::kType, {"odom", false, 50}},
      {readings::Imu::kType, {"imu", true, 100}},
      {readings::JointEncoders::kType, {"joint_states", false, 50}},
      {readings::Sonar::kType, {"range", true, 20}},
      {readings::Navsat::kType, {"fix", true, 10}},
      {readings::Magnetometer::kType, {"magnetic_field", true, 50}},
      {readings::Battery::kType, {"battery_state", false, 1}},
      {readings::Contact::kType, {"contacts", false, 20}},
      {readings::ForceTorque::kType, {"wrench", true, 100}},
      {readings::Positioning::kType, {"pose", false, 20}},
      {readings::Camera::kType, {"camera", true, kUsualImageRate}},
      {readings::Camera::kWideAngleType, {"camera", true, kUsualImageRate}},
      {readings::DepthImage::kType, {"depth", true, kUsualImageRate}},
  };
  return base::FindNamed(kUsualTopics, type);
}

bool Append(const std::vector<std::uint8_t>& bytes, EncodedMessage& out) {
  const auto* begin = reinterpret_cast<const std::byte*>(bytes.data());
  out.head.insert(out.head.end(), begin, begin + bytes.size());
  return !bytes.empty();
}

// Returns the message that recordings and viewers also get. Its type is a type of GSV.
SensorOutput OwnMessage(const RosSensor& sensor, std::string topic, std::string frame,
                        const dds::Qos& qos, const messages::Schema& schema) {
  return {std::move(topic), std::string(schema.name), qos,
          [sensor = sensor.sensor, frame = std::move(frame)](const Reading& reading,
                                                             EncodedMessage& out) {
            const auto bytes = sensor->Encode(reading, frame);
            return bytes && Append(*bytes, out);
          }};
}

SensorOutput CompanionMessage(const RosSensor& sensor, std::string topic, std::string frame,
                              const dds::Qos& qos, const sensing::Companion& companion) {
  return {std::move(topic), std::string(companion.schema->name), qos,
          [sensor = sensor.sensor, frame = std::move(frame)](const Reading& reading,
                                                             EncodedMessage& out) {
            return Append(sensor->EncodeCompanionOf(reading, frame), out);
          }};
}

SensorOutput OdometryMessage(const RosSensor& sensor, std::string topic, const Frames& frames) {
  return {std::move(topic), "nav_msgs/msg/Odometry", kDefaultQos,
          [name = sensor.description.name, odom = frames.odom(), base = frames.base()](
              const Reading& reading, EncodedMessage& out) {
            const auto estimate = sensing::ValuesOf<readings::Odometry>(reading, name);
            if (!estimate) return false;
            messages::nav_msgs::Odometry message;
            message.header = sensing::HeaderOf(reading, odom);
            message.child_frame_id = base;
            const geometry::Quaternion turn = geometry::FromRollPitchYaw({0, 0, estimate->yaw});
            message.pose.pose.position = {estimate->x, estimate->y, 0};
            message.pose.pose.orientation = {turn.x, turn.y, turn.z, turn.w};
            message.twist.twist.linear.x = estimate->linear;
            message.twist.twist.linear.y = estimate->lateral;
            message.twist.twist.angular.z = estimate->angular;
            messages::Encode(message, out.head);
            return true;
          }};
}

// Poses are in the frame "world", whose poses are exact. The frame "map" is not used: the user's
// localization publishes it.
SensorOutput PoseMessage(const RosSensor& sensor, std::string topic) {
  return {std::move(topic), "geometry_msgs/msg/PoseStamped", kDefaultQos,
          [name = sensor.description.name](const Reading& reading, EncodedMessage& out) {
            const auto measured = sensing::ValuesOf<readings::Positioning>(reading, name);
            if (!measured) return false;
            const readings::Placement& p = measured->world_from_sensor;
            const geometry::Quaternion turn = geometry::FromRollPitchYaw({p.roll, p.pitch, p.yaw});
            messages::geometry_msgs::PoseStamped message;
            message.header = sensing::HeaderOf(reading, std::string(kRosWorldFrame));
            message.pose.position = {p.x, p.y, p.z};
            message.pose.orientation = {turn.x, turn.y, turn.z, turn.w};
            messages::Encode(message, out.head);
            return true;
          }};
}

std::string OpticalFrame(const std::string& frame) {
  return sensing::FrameOf(frame, sensing::kOpticalFrame);
}

SensorOutput ImageMessage(const std::string& base, const std::string& frame) {
  return {base + "/image_raw", kImageType, kLargeDataQos,
          [frame = OpticalFrame(frame)](const Reading& reading, EncodedMessage& out) {
            if (reading.image == nullptr) return false;
            EncodeImageHead(*reading.image, reading.time, frame, out.head);
            out.rest = std::as_bytes(std::span(reading.image->pixels));
            return true;
          }};
}

SensorOutput DepthMessage(const RosSensor& sensor, const std::string& base,
                          const std::string& frame) {
  return {base + "/image_raw", kImageType, kLargeDataQos,
          [name = sensor.description.name, frame = OpticalFrame(frame)](const Reading& reading,
                                                                        EncodedMessage& out) {
            const auto image = sensing::ValuesOf<readings::DepthImage>(reading, name);
            if (!image || !image->IsComplete()) return false;
            EncodeDepth(image->width, image->height, image->depth, reading.time, frame, out.head);
            return true;
          }};
}

// Collects the outputs of one sensor.
class OutputList {
 public:
  OutputList(const RosSensor& sensor, std::string base, std::string frame)
      : sensor_(sensor),
        sent_(sensor.type->MessagesOf(sensor.description)),
        base_(std::move(base)),
        frame_(std::move(frame)) {}

  void AddImages() {
    outputs_.push_back(ImageMessage(base_, frame_));
    AddOwn(base_ + "/image_raw/compressed", OpticalFrame(frame_), kLargeDataQos);
    AddCompanion(base_ + "/camera_info");
  }
  void AddDepth() {
    outputs_.push_back(DepthMessage(sensor_, base_, frame_));
    AddOwn(base_ + "/points", frame_, kLargeDataQos);
    AddCompanion(base_ + "/camera_info");
  }
  // A lidar with one row is published as a LaserScan. A lidar with several rows is published as a
  // PointCloud2, which is its companion message.
  void AddLidar() {
    if (!sent_.companion) return AddOwn(base_, frame_, kSensorDataQos);
    AddCompanion(sensor_.is_only ? "points" : RosName(sensor_.description.name) + "/points",
                 kLargeDataQos);
  }
  void AddOdometry(const Frames& frames) {
    outputs_.push_back(OdometryMessage(sensor_, base_, frames));
  }
  void AddPose() { outputs_.push_back(PoseMessage(sensor_, base_)); }
  void AddOther(const dds::Qos& qos) {
    AddOwn(base_, frame_, qos);
    if (sent_.companion) AddCompanion(base_ + "/" + sent_.companion->topic);
  }
  std::vector<SensorOutput> Take() { return std::move(outputs_); }

 private:
  void AddOwn(std::string topic, std::string frame, const dds::Qos& qos) {
    if (sent_.schema == nullptr) return;
    outputs_.push_back(OwnMessage(sensor_, std::move(topic), std::move(frame), qos, *sent_.schema));
  }
  void AddCompanion(std::string topic, const dds::Qos& qos = kSensorDataQos) {
    if (!sent_.companion) return;
    outputs_.push_back(CompanionMessage(sensor_, std::move(topic), frame_, qos, *sent_.companion));
  }

  const RosSensor& sensor_;
  const sensing::SensorMessages sent_;
  const std::string base_, frame_;
  std::vector<SensorOutput> outputs_;
};

}  // namespace

std::string UsualTopicOf(const sensing::SensorType& type,
                         const model::SensorDescription& description) {
  const bool has_rows =
      type.name == readings::Lidar::kType && type.MessagesOf(description).companion.has_value();
  if (has_rows) return "points";
  const UsualTopic* const usual = FindUsualTopic(type.name);
  return usual == nullptr ? std::string() : usual->topic;
}

std::vector<SensorOutput> OutputsOf(const RosSensor& sensor, const Frames& frames,
                                    const model::Model& model) {
  const UsualTopic* const usual = FindUsualTopic(sensor.type->name);
  const std::string name = RosName(sensor.description.name);
  const std::string type = sensor.type->name;
  const bool is_camera =
      type == readings::Camera::kType || type == readings::Camera::kWideAngleType;
  const bool is_depth = type == readings::DepthImage::kType;
  std::string base = name;
  if (usual != nullptr && sensor.is_only) base = usual->topic;
  if (usual != nullptr && !sensor.is_only && !is_camera && !is_depth)
    base += std::string("/") + usual->topic;
  OutputList list(sensor, std::move(base), frames.OfSensor(model, sensor.description));
  if (is_camera) {
    list.AddImages();
  } else if (is_depth) {
    list.AddDepth();
  } else if (type == readings::Lidar::kType) {
    list.AddLidar();
  } else if (type == readings::Odometry::kType) {
    list.AddOdometry(frames);
  } else if (type == readings::Positioning::kType) {
    list.AddPose();
  } else {
    list.AddOther(usual != nullptr && usual->is_sensor_data ? kSensorDataQos : kDefaultQos);
  }
  return list.Take();
}

double RateOf(const RosSensor& sensor) {
  if (sensor.description.update_rate > 0) return sensor.description.update_rate;
  if (const UsualTopic* const usual = FindUsualTopic(sensor.type->name)) return usual->rate;
  return sensor.sensor->TakesLong() ? kUsualImageRate : kUsualRate;
}

SensorSource::SensorSource(RosSensor sensor, std::vector<SensorOutput> outputs, Node& node)
    : Source(base::FromSeconds(1 / RateOf(sensor))), sensor_(std::move(sensor)) {
  for (SensorOutput& output : outputs) {
    dds::Writer* const writer = node.Advertise(output.topic, output.type, output.qos);
    if (writer != nullptr) channels_.push_back({std::move(output), writer});
  }
}

bool SensorSource::is_wanted() const {
  return !has_failed_ &&
         std::any_of(channels_.begin(), channels_.end(),
                     [](const Channel& channel) { return channel.writer->has_readers(); });
}

void SensorSource::Publish(const Moment& moment) {
  const int body = moment.snapshot->layout->Find(sensor_.body);
  if (body < 0 || has_failed_) return;
  const auto reading = sensor_.sensor->Sample({moment.snapshot, body, moment.seed, moment.rays});
  if (!reading) {
    has_failed_ = true;
    spdlog::warn("{}/{} is not published to ROS 2: {}", sensor_.body, sensor_.description.name,
                 reading.error().Sentence());
    return;
  }
  for (const Channel& channel : channels_) {
    if (!channel.writer->has_readers()) continue;
    message_.head.clear();
    message_.rest = {};
    if (channel.output.encode(*reading, message_)) {
      channel.writer->WriteParts(message_.head, message_.rest);
    }
  }
}

}  // namespace gsv::ros2
