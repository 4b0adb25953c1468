// The sensors of a robot. There is one class per sensor type, with readings as structs of
// gsv/readings/catalogue.h. The classes are the same for every robot. Only the SensorPort, which
// fetches the readings, differs.
//
// Frames   REP-103: x forward, y left, z up.
// Units    metres, radians, seconds.
// Errors   a reading of the wrong size and a failing sensor end the run with an error. After the
//          end of the run a reading has no values: structs have their default values, and a sonar
//          returns its maximum range.
// Threads  as Robot.
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

// Parameters by name; docs/sensors.md lists the parameters of each sensor type.
using Parameters = std::map<std::string, std::variant<double, bool, std::string>>;

// The name, the type, the pose and the parameters of a sensor.
struct SensorTraits {
  std::string name;
  std::string type;
  Placement robot_from_sensor;
  double update_rate = 0;  // in Hz; 0 for a new reading at each request
  Parameters parameters;
};

// A reading. The struct of its sensor type defines the layout of `values` and `labels`.
struct Reading {
  std::string sensor;
  SimTime time{0};
  std::vector<double> values;
  std::vector<std::string> labels;  // names that belong to the values, if the type has any
};

// The source of a Sensor's readings: a robot in this process, or a reference to a robot in another
// process.
class SensorPort {
 public:
  virtual ~SensorPort() = default;
  virtual const SensorTraits& traits() const = 0;
  // Reads the sensor. Returns false after the end of the run, and if the sensor fails, which ends
  // the run. `reading` then has no values.
  virtual bool Measure(Reading& reading) = 0;
  // Returns an image. The image is empty when Measure() would return false, and for sensors without
  // images.
  virtual Image TakeImage() = 0;
  // Sends a message, see Radio::Send(). Sensors other than radios return an error.
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

// The base class of all sensors.
class Sensor {
 public:
  explicit Sensor(std::unique_ptr<SensorPort> port) : port_(std::move(port)) {}

  const SensorTraits& traits() const { return port_->traits(); }
  // Takes a reading, which is valid until the next call.
  const Reading& Measure() {
    has_measured_ = port_->Measure(reading_);
    return reading_;
  }
  // Takes a reading, which the caller owns.
  Reading TakeReading() {
    Measure();
    return std::exchange(reading_, {});
  }
  // Decodes `reading`, which must be the newest reading of this sensor or a copy of it. Spans in
  // the result refer to the data of `reading`. Returns nullopt after the end of the run. If the
  // reading has the wrong size, returns nullopt and ends the run with an error.
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
  // Takes a reading as a struct. The struct is default-constructed if there is no reading.
  template <typename Values>
  Values MeasureAs() {
    return In<Values>(Measure()).value_or(Values());
  }
  // Returns a numeric parameter, or `otherwise` if it is not set.
  double Number(const std::string& parameter, double otherwise) const;

 private:
  std::unique_ptr<SensorPort> port_;
  Reading reading_;            // the newest reading
  bool has_measured_ = false;  // whether the newest reading is valid
};

// Measures the distance to the nearest object in a cone.
class Sonar : public Sensor {
 public:
  static constexpr const char* kType = readings::Sonar::kType;
  explicit Sonar(std::unique_ptr<SensorPort> port);

  // Returns the distance in m to the nearest echo, or max_range() if there is none.
  double Range();
  double max_range() const { return max_range_; }

 private:
  double max_range_;
};

// A laser scanner, with one or more rows of beams.
class Lidar : public Sensor {
 public:
  static constexpr const char* kType = readings::Lidar::kType;
  using Sensor::Sensor;

  // One scan. Beams are in rows, from the lowest row; within a row, from the smallest azimuth.
  struct Scan {
    std::vector<double> ranges;       // in m for each beam, see Ranges()
    std::vector<double> intensities;  // for each beam; empty without the parameter intensity_scale
  };
  // Takes a scan.
  Scan Read();
  // Returns the distance in m for each beam; infinite if the beam hit nothing, and -infinity if it
  // hit something nearer than the minimum range. Valid until the next call.
  const std::vector<double>& Ranges();

 private:
  std::vector<double> ranges_;  // the ranges of a reading that also has intensities
};

// A colour camera, with a pinhole or a wide-angle lens.
class Camera : public Sensor {
 public:
  static constexpr const char* kType = readings::Camera::kType;
  static constexpr const char* kWideAngleType = readings::Camera::kWideAngleType;
  using Sensor::Sensor;

  // Whether a sensor of this type is a Camera.
  static bool Is(const std::string& type) { return type == kType || type == kWideAngleType; }

  Image TakeImage() { return port().TakeImage(); }
  [[deprecated("use TakeImage()")]] Image TakePicture() { return TakeImage(); }
};

// Measures its own pose in the world.
class PositioningSystem : public Sensor {
 public:
  static constexpr const char* kType = readings::Positioning::kType;
  using Sensor::Sensor;

  // Returns the pose of the sensor in the world.
  Placement Locate();
};

// Measures angular velocity and specific force in the sensor frame.
class Imu : public Sensor {
 public:
  static constexpr const char* kType = readings::Imu::kType;
  using Sensor::Sensor;

  using Motion = readings::Imu;
  // Returns angular velocity and specific force.
  Motion Read();
  [[deprecated("use Read()")]] Motion Feel() { return Read(); }
};

// Estimates the robot's pose from the rotation of its wheels (dead reckoning).
class Odometer : public Sensor {
 public:
  static constexpr const char* kType = readings::Odometry::kType;
  using Sensor::Sensor;

  using Estimate = readings::Odometry;
  // Returns the estimate.
  Estimate Read();
  [[deprecated("use Read()")]] Estimate Reckon() { return Read(); }
};

// Measures position and velocity in WGS84.
class GnssReceiver : public Sensor {
 public:
  static constexpr const char* kType = readings::Navsat::kType;
  using Sensor::Sensor;

  using Position = readings::Navsat;
  // Returns position and velocity.
  Position Fix();
};
using SatelliteReceiver [[deprecated("use gsv::GnssReceiver")]] = GnssReceiver;

// Measures the magnetic field in the sensor frame, in tesla.
class Magnetometer : public Sensor {
 public:
  static constexpr const char* kType = readings::Magnetometer::kType;
  using Sensor::Sensor;

  // Returns the magnetic field.
  Vector Field();
};

// Measures the height above a reference height, and the vertical velocity. The reference is the
// parameter `vertical_reference` (default: the height at the start).
class Altimeter : public Sensor {
 public:
  static constexpr const char* kType = readings::Altimeter::kType;
  using Sensor::Sensor;

  using Height = readings::Altimeter;
  // Returns height and vertical speed.
  Height Measured();
};

// Reports the contacts of the robot with other bodies.
class Bumper : public Sensor {
 public:
  static constexpr const char* kType = readings::Contact::kType;
  using Sensor::Sensor;

  using Touch = readings::Touch;
  // Whether there is a contact.
  bool IsPressed() { return !Touches().empty(); }
  // Returns the present contacts.
  std::vector<Touch> Touches();
};

// Measures the force and the torque that a joint transmits.
class ForceTorque : public Sensor {
 public:
  static constexpr const char* kType = readings::ForceTorque::kType;
  using Sensor::Sensor;

  using Wrench = readings::ForceTorque;
  // Returns force and torque.
  Wrench Read();
};

// Measures the positions and the velocities of the robot's joints.
class JointEncoders : public Sensor {
 public:
  static constexpr const char* kType = readings::JointEncoders::kType;
  using Sensor::Sensor;

  using Joint = readings::EncodedJoint;
  // Returns a reading of each joint.
  std::vector<Joint> Joints();
};

// Measures the charge of the robot's battery.
class Battery : public Sensor {
 public:
  static constexpr const char* kType = readings::Battery::kType;
  using Sensor::Sensor;

  using Charge = readings::Battery;
  // Returns the present charge.
  Charge Level();
};

// Lists the models in its field of view, with their poses.
class LogicalCamera : public Sensor {
 public:
  static constexpr const char* kType = readings::LogicalCamera::kType;
  using Sensor::Sensor;

  using Sighting = readings::Sighting;
  [[deprecated("use Read()")]] std::vector<Sighting> Look() { return Read(); }
  // Returns the visible models.
  std::vector<Sighting> Read();
};

// Exchanges messages with other robots. A message arrives at radios in range with the next step.
// Messages of different senders arrive in the order of the senders' names. Messages of one sender
// arrive in the order of sending.
class Radio : public Sensor {
 public:
  static constexpr const char* kType = readings::Radio::kType;
  using Sensor::Sensor;

  struct Message {
    std::string sender;   // the name of the robot
    std::string content;  // the bytes that were sent
    SimTime sent{0};      // simulated time of sending
    double strength = 0;  // in dBm
  };

  // Sends to the robot with that name, without acknowledgement. Fails if the message is longer than
  // the radio's max_size, if too many messages are sent in one step, or if the run has ended.
  base::Status Send(const std::string& receiver, const std::string& content) {
    return port().Send(receiver, content);
  }
  // Sends to all robots in range.
  base::Status Broadcast(const std::string& content) { return port().Send("", content); }

  // Returns the messages that were received since the last call, the oldest first.
  std::vector<Message> Receive();
  // The number of lost messages: later messages have replaced them in the inbox before Receive()
  // was called.
  std::uint64_t missed() const { return missed_; }

 private:
  std::uint64_t received_ = 0;  // number of the last received message
  std::uint64_t missed_ = 0;    // number of lost messages, see missed()
};

// A tag that measures the distance to one radio anchor.
class Ranging : public Sensor {
 public:
  static constexpr const char* kType = readings::Ranging::kType;
  using Sensor::Sensor;

  // Returns the distance in m; infinite if the anchor is not received.
  double Distance();
};

// Measures the depth of each pixel.
class DepthCamera : public Sensor {
 public:
  static constexpr const char* kType = readings::DepthImage::kType;
  using Sensor::Sensor;

  struct Image {
    int width = 0, height = 0;
    // in m along the view, in rows from the top; infinite for the background
    std::vector<double> depth;
  };
  // Takes an image of depths.
  Image TakeDepth();
};

// Labels each pixel with the model that it shows.
class SegmentationCamera : public Sensor {
 public:
  static constexpr const char* kType = readings::SegmentedImage::kType;
  using Sensor::Sensor;

  // A pixel with label n shows names[n - 1]. Label 0 is the background. Rows are stored from the
  // top.
  struct Image {
    int width = 0, height = 0;
    std::vector<std::uint32_t> labels;
    std::vector<std::string> names;
  };
  // Takes an image of labels.
  Image Segment();
};

// Measures the temperature of each pixel.
class ThermalCamera : public Sensor {
 public:
  static constexpr const char* kType = readings::ThermalImage::kType;
  using Sensor::Sensor;

  struct Image {
    int width = 0, height = 0;
    double resolution = 0;  // K
    // in K, in rows from the top, in whole steps of the resolution
    std::vector<double> temperature;
  };
  Image TakeTemperatures();
};

// Measures the surface normal at each pixel.
class NormalsCamera : public Sensor {
 public:
  static constexpr const char* kType = readings::NormalImage::kType;
  using Sensor::Sensor;

  struct Image {
    int width = 0, height = 0;
    // Three values x, y, z per pixel, in rows from the top. They are the unit normal of the visible
    // surface, towards the camera, in the sensor frame, or NaN where the normal is unknown.
    std::vector<double> normals;
  };
  Image TakeNormals();
};

// Finds the models in its image, with their bounding boxes.
class BoundingBoxCamera : public Sensor {
 public:
  static constexpr const char* kType = readings::BoundingBoxes::kType;
  using Sensor::Sensor;

  using Box = readings::BoundingBox;
  // Returns the bounding boxes of the visible models.
  std::vector<Box> Detect();
};

}  // namespace gsv
