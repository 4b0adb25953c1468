// Publishes a sensor of a robot. Each sample is converted to all the sensor's ROS 2 messages.
//
// A reading is a function of the snapshot, so the sensor is sampled here again. The robot's
// behaviour gets the same value, and the simulation does not change.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "gsv/messages/cdr.h"
#include "gsv/ros2/frames.h"
#include "gsv/ros2/node.h"
#include "gsv/ros2/source.h"
#include "gsv/sensing/registry.h"

namespace gsv::ros2 {

// An encoded message in two parts. The second part contains the pixels of an image, or is empty.
struct EncodedMessage {
  messages::Bytes head;             // begins with the encapsulation header
  std::span<const std::byte> rest;  // the pixels; refers to the reading
};

// One of the messages to which a reading is converted.
struct SensorOutput {
  std::string topic;  // relative to the robot's namespace
  std::string type;   // "sensor_msgs/msg/LaserScan"
  dds::Qos qos;
  // Encodes a reading's message into `out`, which is empty. Returns false if there is no message
  // for this reading.
  std::function<bool(const sensing::Reading& reading, EncodedMessage& out)> encode;
};

// A sensor of a robot, and its type.
struct RosSensor {
  std::string body;  // name of the robot's body in the world
  model::SensorDescription description;
  // the sensor's type; refers to the simulation's registry
  const sensing::SensorType* type = nullptr;
  std::shared_ptr<const sensing::Sensor> sensor;  // samples the readings
  // Whether it is the robot's only sensor with the usual topic of its type. Then its topic has the
  // usual name.
  bool is_only = true;
};

// Returns the usual topic of a sensor, such as "camera" for cameras and for wide-angle cameras. Empty
// if its type has no usual topic.
std::string UsualTopicOf(const sensing::SensorType& type,
                         const model::SensorDescription& description);

// Returns the messages of a sensor. The sensor's type determines their topics, such as "scan" for a
// lidar and "camera/image_raw" for a camera. If a robot has several sensors with the same usual
// topic, the topics begin with the sensors' names. If a type has no usual topic, the topic is the
// sensor's name.
std::vector<SensorOutput> OutputsOf(const RosSensor& sensor, const Frames& frames,
                                    const model::Model& model);

// Returns the rate in Hz: the sensor's own rate if it has one, else the usual rate of its type.
double RateOf(const RosSensor& sensor);

// Publishes the messages of one sensor.
class SensorSource final : public Source {
 public:
  SensorSource(RosSensor sensor, std::vector<SensorOutput> outputs, Node& node);

  bool is_wanted() const override;
  bool takes_long() const override { return sensor_.sensor->TakesLong(); }
  void Publish(const Moment& moment) override;

 private:
  // An output and its writer.
  struct Channel {
    SensorOutput output;
    dds::Writer* writer = nullptr;  // never null
  };

  const RosSensor sensor_;
  std::vector<Channel> channels_;
  EncodedMessage message_;   // the message that is encoded now; its memory is reused
  bool has_failed_ = false;  // whether a reading has failed; no more readings are then published
};

}  // namespace gsv::ros2
