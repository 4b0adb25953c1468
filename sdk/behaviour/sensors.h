// The sensors of a robot as its behaviour reads them: one class for each type, which gives its
// readings as the structs of gsv/readings/catalogue.h. The classes are the same for every robot;
// only the SensorPort differs, which brings the readings from wherever the robot is.
//
// Frames   REP-103: x forward, y left, z up.
// Units    metres, radians, seconds.
// Errors   a reading that has not the size of its type ends the run with an error, as a sensor that
//          fails does. After the end of the run a reading has no values, and what is read from it
//          is zero, or a sonar's maximum.
// Threads  those of the robot.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/base/sim_time.h"
#include "gsv/readings/catalogue.h"

namespace gsv {

using base::SimTime;

using readings::Placement;
using readings::Vector;

// An RGB image.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;  // rows from the top, 3 bytes per pixel
};
using Picture [[deprecated("use gsv::Image")]] = Image;

// Parameters by name; each sensor type documents its own.
using Parameters = std::map<std::string, std::variant<double, bool, std::string>>;

struct SensorTraits {
  std::string name;
  std::string type;
  Placement robot_from_sensor;
  double update_rate = 0;  // Hz; 0: a new reading whenever it is asked
  Parameters parameters;
};

// One reading; `values` and `labels` are laid out as its type's struct says.
struct Reading {
  std::string sensor;
  SimTime time{0};
  std::vector<double> values;
  std::vector<std::string> labels;  // names that go with the values, where the type has any
};

// What a Sensor reads from: a robot in this process, or a reference to one elsewhere.
class SensorPort {
 public:
  virtual ~SensorPort() = default;
  virtual const SensorTraits& traits() const = 0;
  // False after the end of the run, and when the sensor fails, which ends the run; then `reading`
  // has no values.
  virtual bool Measure(Reading& reading) = 0;
  // Empty in the same cases, and of sensors that take none.
  virtual Image TakeImage() = 0;
  // Of a radio: see Radio::Send(). An error of any other sensor.
  virtual base::Status Send(const std::string& receiver, const std::string& content) = 0;
  // Commands an actuator, see actuators.h. Any other sensor returns an error.
  virtual base::Status CommandDevice(const std::vector<double>& values,
                                     const std::string& word) = 0;
  [[deprecated("use CommandDevice()")]] base::Status Act(const std::vector<double>& values,
                                                         const std::string& word) {
    return CommandDevice(values, word);
  }
  // Ends the run with this error.
  virtual void Fail(const base::Error& error) = 0;
};

// Any sensor.
class Sensor {
 public:
  explicit Sensor(std::unique_ptr<SensorPort> port) : port_(std::move(port)) {}

  const SensorTraits& traits() const { return port_->traits(); }
  // Valid until the next one.
  const Reading& Measure() {
    has_measured_ = port_->Measure(reading_);
    return reading_;
  }
  // One that is the caller's.
  Reading TakeReading() {
    Measure();
    return std::exchange(reading_, {});
  }
  // The struct that the newest reading, or a copy of it, stands for; spans in it view that reading.
  // Nothing after the end of the run, and when the reading has another size than its type's, which
  // ends the run with an error.
  template <typename Values>
  std::optional<Values> In(const Reading& reading) {
    if (!has_measured_) return std::nullopt;
    auto values = readings::Decode<Values>(reading.values, reading.labels, traits().name);
    if (values) return *std::move(values);
    has_measured_ = false;
    port_->Fail(values.error());
    return std::nullopt;
  }

 protected:
  SensorPort& port() { return *port_; }
  // What it measures now; as it is made where there is nothing.
  template <typename Values>
  Values MeasureAs() {
    return In<Values>(Measure()).value_or(Values());
  }
  // A parameter that is a number.
  double Number(const std::string& parameter, double otherwise) const;

 private:
  std::unique_ptr<SensorPort> port_;
  Reading reading_;
  bool has_measured_ = false;  // the newest reading is one
};

class Sonar : public Sensor {
 public:
  static constexpr const char* kType = readings::Sonar::kType;
  explicit Sonar(std::unique_ptr<SensorPort> port);

  // m to the nearest echo; max_range() when there is none.
  double Range();
  double max_range() const { return max_range_; }

 private:
  double max_range_;
};

class Lidar : public Sensor {
 public:
  static constexpr const char* kType = readings::Lidar::kType;
  using Sensor::Sensor;

  // m, beam by beam; infinite where nothing was hit.
  const std::vector<double>& Ranges() { return Measure().values; }
};

class Camera : public Sensor {
 public:
  static constexpr const char* kType = readings::Camera::kType;
  static constexpr const char* kWideAngleType = readings::Camera::kWideAngleType;
  using Sensor::Sensor;

  static bool Is(const std::string& type) { return type == kType || type == kWideAngleType; }

  Image TakeImage() { return port().TakeImage(); }
  [[deprecated("use TakeImage()")]] Image TakePicture() { return TakeImage(); }
};

class PositioningSystem : public Sensor {
 public:
  static constexpr const char* kType = readings::Positioning::kType;
  using Sensor::Sensor;

  Placement Locate() { return MeasureAs<readings::Positioning>().world_from_sensor; }
};

class Imu : public Sensor {
 public:
  static constexpr const char* kType = readings::Imu::kType;
  using Sensor::Sensor;

  using Motion = readings::Imu;
  Motion Read() { return MeasureAs<Motion>(); }
  [[deprecated("use Read()")]] Motion Feel() { return Read(); }
};

class Odometer : public Sensor {
 public:
  static constexpr const char* kType = readings::Odometry::kType;
  using Sensor::Sensor;

  using Estimate = readings::Odometry;
  Estimate Read() { return MeasureAs<Estimate>(); }
  [[deprecated("use Read()")]] Estimate Reckon() { return Read(); }
};

class GnssReceiver : public Sensor {
 public:
  static constexpr const char* kType = readings::Navsat::kType;
  using Sensor::Sensor;

  using Position = readings::Navsat;
  Position Fix() { return MeasureAs<Position>(); }
};
using SatelliteReceiver [[deprecated("use gsv::GnssReceiver")]] = GnssReceiver;

class Magnetometer : public Sensor {
 public:
  static constexpr const char* kType = readings::Magnetometer::kType;
  using Sensor::Sensor;

  Vector Field() { return MeasureAs<readings::Magnetometer>().field; }
};

class Altimeter : public Sensor {
 public:
  static constexpr const char* kType = readings::Altimeter::kType;
  using Sensor::Sensor;

  using Height = readings::Altimeter;
  Height Measured() { return MeasureAs<Height>(); }
};

class Bumper : public Sensor {
 public:
  static constexpr const char* kType = readings::Contact::kType;
  using Sensor::Sensor;

  using Touch = readings::Touch;
  bool IsPressed() { return !Touches().empty(); }
  std::vector<Touch> Touches() { return MeasureAs<readings::Contact>().touches; }
};

class JointEncoders : public Sensor {
 public:
  static constexpr const char* kType = readings::JointEncoders::kType;
  using Sensor::Sensor;

  using Joint = readings::EncodedJoint;
  std::vector<Joint> Joints() { return MeasureAs<readings::JointEncoders>().joints; }
};

class Battery : public Sensor {
 public:
  static constexpr const char* kType = readings::Battery::kType;
  using Sensor::Sensor;

  using Charge = readings::Battery;
  Charge Level() { return MeasureAs<Charge>(); }
};

class LogicalCamera : public Sensor {
 public:
  static constexpr const char* kType = readings::LogicalCamera::kType;
  using Sensor::Sensor;

  using Sighting = readings::Sighting;
  [[deprecated("use Read()")]] std::vector<Sighting> Look() { return Read(); }
  std::vector<Sighting> Read() { return MeasureAs<readings::LogicalCamera>().sightings; }
};

// Sends to other robots and hears them. What is sent at an instant is heard with the next step, in
// the order of the senders' names and, of each, in that of sending, by those that are near enough.
class Radio : public Sensor {
 public:
  static constexpr const char* kType = readings::Radio::kType;
  using Sensor::Sensor;

  struct Message {
    std::string sender;  // robot
    std::string content;
    SimTime sent{0};
    double strength = 0;  // dBm
  };

  // To the robot of that name; nobody says whether it hears. Fails when the message is longer than
  // the radio's max_size, when too many are sent in one step, and after the end of the run.
  base::Status Send(const std::string& receiver, const std::string& content) {
    return port().Send(receiver, content);
  }
  // To all.
  base::Status Broadcast(const std::string& content) { return port().Send("", content); }

  // What was heard since the last time, the oldest first.
  std::vector<Message> Receive();
  // Messages that were pushed out of the radio's inbox by later ones before Receive() came.
  std::uint64_t missed() const { return missed_; }

 private:
  std::uint64_t received_ = 0;  // the number of the last
  std::uint64_t missed_ = 0;
};

class DepthCamera : public Sensor {
 public:
  static constexpr const char* kType = readings::DepthImage::kType;
  using Sensor::Sensor;

  struct Image {
    int width = 0, height = 0;
    std::vector<double> depth;  // m along the view, rows from the top; infinite where nothing is
  };
  Image TakeDepth() {
    const auto image = MeasureAs<readings::DepthImage>();
    return {image.width, image.height, {image.depth.begin(), image.depth.end()}};
  }
};

class SegmentationCamera : public Sensor {
 public:
  static constexpr const char* kType = readings::SegmentedImage::kType;
  using Sensor::Sensor;

  // A pixel of label n shows names[n - 1], one of label 0 nothing. Rows from the top.
  struct Image {
    int width = 0, height = 0;
    std::vector<std::uint32_t> labels;
    std::vector<std::string> names;
  };
  Image Segment() {
    const auto image = MeasureAs<readings::SegmentedImage>();
    return {image.width,
            image.height,
            {image.pixels.begin(), image.pixels.end()},
            {image.names.begin(), image.names.end()}};
  }
};

class ThermalCamera : public Sensor {
 public:
  static constexpr const char* kType = readings::ThermalImage::kType;
  using Sensor::Sensor;

  struct Image {
    int width = 0, height = 0;
    double resolution = 0;            // K
    std::vector<double> temperature;  // K, rows from the top, whole steps of the resolution
  };
  Image TakeTemperatures() {
    const auto image = MeasureAs<readings::ThermalImage>();
    return {image.width,
            image.height,
            image.resolution,
            {image.temperature.begin(), image.temperature.end()}};
  }
};

class NormalsCamera : public Sensor {
 public:
  static constexpr const char* kType = readings::NormalImage::kType;
  using Sensor::Sensor;

  struct Image {
    int width = 0, height = 0;
    // Three values x, y, z a pixel, rows from the top: the unit normal of the visible surface,
    // towards the camera, in the sensor frame; NaN where it is unknown.
    std::vector<double> normals;
  };
  Image TakeNormals() {
    const auto image = MeasureAs<readings::NormalImage>();
    return {image.width, image.height, {image.normals.begin(), image.normals.end()}};
  }
};

class BoundingBoxCamera : public Sensor {
 public:
  static constexpr const char* kType = readings::BoundingBoxes::kType;
  using Sensor::Sensor;

  using Box = readings::BoundingBox;
  std::vector<Box> Detect() { return MeasureAs<readings::BoundingBoxes>().boxes; }
};

}  // namespace gsv
