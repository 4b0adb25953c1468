// The sensors of a robot as its behaviour reads them: one class for each type, which says what the
// values of a reading mean. The classes are the same for every robot; only the SensorPort differs,
// which brings the readings from wherever the robot is.
//
// Frames   REP-103: x forward, y left, z up.
// Units    metres, radians, seconds.
// Errors   after the end of the run a reading has no values, and what is read from it is zero, or a
//          sonar's maximum.
// Threads  those of the robot.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/base/sim_time.h"

namespace gsv {

using base::SimTime;

// Fixed-axis roll, pitch, yaw as in URDF.
struct Placement {
  double x = 0, y = 0, z = 0;
  double roll = 0, pitch = 0, yaw = 0;
};

struct Picture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;  // rows from the top, 3 bytes a pixel
};

// Parameters by name; each sensor type documents its own.
using Parameters = std::map<std::string, std::variant<double, bool, std::string>>;

struct SensorTraits {
  std::string name;
  std::string type;
  Placement robot_from_sensor;
  double update_rate = 0;  // Hz; 0: a new reading whenever it is asked
  Parameters parameters;
};

// One reading; the shape of `values` is its type's.
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
  virtual Picture TakePicture() = 0;
  // Of a radio: see Radio::Send(). An error of any other sensor.
  virtual base::Status Send(const std::string& receiver, const std::string& content) = 0;
  // Of an actuator: tells it what to do, see actuators.h. An error of any other sensor.
  virtual base::Status Act(const std::vector<double>& values, const std::string& word) = 0;
};

// Any sensor.
class Sensor {
 public:
  explicit Sensor(std::unique_ptr<SensorPort> port) : port_(std::move(port)) {}

  const SensorTraits& traits() const { return port_->traits(); }
  // Valid until the next one.
  const Reading& Measure() {
    port_->Measure(reading_);
    return reading_;
  }
  // One that is the caller's.
  Reading TakeReading() {
    port_->Measure(reading_);
    return std::exchange(reading_, {});
  }

 protected:
  SensorPort& port() { return *port_; }
  // A parameter that is a number.
  double Number(const std::string& parameter, double otherwise) const;

 private:
  std::unique_ptr<SensorPort> port_;
  Reading reading_;
};

class Sonar : public Sensor {
 public:
  static constexpr const char* kType = "sonar";
  explicit Sonar(std::unique_ptr<SensorPort> port);

  // m to the nearest echo; max_range() when there is none.
  double Range();
  double max_range() const { return max_range_; }

 private:
  double max_range_;
};

class Lidar : public Sensor {
 public:
  static constexpr const char* kType = "lidar";
  using Sensor::Sensor;

  // m, beam by beam; infinite where nothing was hit.
  const std::vector<double>& Ranges() { return Measure().values; }
};

class Camera : public Sensor {
 public:
  static constexpr const char* kType = "camera";
  static constexpr const char* kWideAngleType = "wideangle_camera";  // with another lens
  using Sensor::Sensor;

  static bool Is(const std::string& type) { return type == kType || type == kWideAngleType; }

  Picture TakePicture() { return port().TakePicture(); }
};

class PositioningSystem : public Sensor {
 public:
  static constexpr const char* kType = "positioning";
  using Sensor::Sensor;

  Placement Locate();  // world_from_sensor
};

struct Vector {
  double x = 0, y = 0, z = 0;
};

class Imu : public Sensor {
 public:
  static constexpr const char* kType = "imu";
  using Sensor::Sensor;

  // In the sensor's frame; at rest the specific force is 9.8 m/s² upwards.
  struct Motion {
    Vector angular_velocity;  // rad/s
    Vector specific_force;    // m/s²
  };
  Motion Feel();
};

class Odometer : public Sensor {
 public:
  static constexpr const char* kType = "odometry";
  using Sensor::Sensor;

  // Dead reckoning by the wheels, from where the robot started.
  struct Estimate {
    double x = 0, y = 0, yaw = 0;
    double linear = 0, angular = 0;  // m/s, rad/s
  };
  Estimate Reckon();
};

class SatelliteReceiver : public Sensor {
 public:
  static constexpr const char* kType = "navsat";
  using Sensor::Sensor;

  // WGS84.
  struct Position {
    double latitude_deg = 0, longitude_deg = 0, altitude = 0;
    double east = 0, north = 0, up = 0;  // m/s
  };
  Position Fix();
};

class Magnetometer : public Sensor {
 public:
  static constexpr const char* kType = "magnetometer";
  using Sensor::Sensor;

  Vector Field();  // tesla, in the sensor's frame
};

class Altimeter : public Sensor {
 public:
  static constexpr const char* kType = "altimeter";
  using Sensor::Sensor;

  struct Height {
    double position = 0, velocity = 0;  // m above the reference, m/s
    double reference = 0;               // m, in the world
  };
  Height Measured();
};

class Bumper : public Sensor {
 public:
  static constexpr const char* kType = "contact";
  using Sensor::Sensor;

  // In the sensor's frame; the normal points from the robot to what it touches.
  struct Touch {
    std::string other;
    Vector point, normal;
    double depth = 0;
    double closing_speed = 0;  // m/s at which the two met; 0: they touched already
  };
  bool IsPressed() { return !Measure().values.empty(); }
  std::vector<Touch> Touches();
};

class JointEncoders : public Sensor {
 public:
  static constexpr const char* kType = "joint_encoders";
  using Sensor::Sensor;

  struct Joint {
    std::string name;
    double position = 0, velocity = 0;  // rad and rad/s; of prismatic joints m and m/s
  };
  std::vector<Joint> Joints();
};

class Battery : public Sensor {
 public:
  static constexpr const char* kType = "battery";
  using Sensor::Sensor;

  struct Charge {
    double voltage = 0, current = 0;  // V, A drawn
    double charge = 0, capacity = 0;  // Ah
    double fraction = 0;
  };
  Charge Level();
};

class LogicalCamera : public Sensor {
 public:
  static constexpr const char* kType = "logical_camera";
  using Sensor::Sensor;

  struct Sighting {
    std::string name;
    Placement sensor_from_model;
  };
  std::vector<Sighting> Look();
};

// Sends to other robots and hears them. What is sent at an instant is heard with the next step, in
// the order of the senders' names and, of each, in that of sending, by those that are near enough.
class Radio : public Sensor {
 public:
  static constexpr const char* kType = "radio";
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
  static constexpr const char* kType = "depth_camera";
  using Sensor::Sensor;

  struct Image {
    int width = 0, height = 0;
    std::vector<double> depth;  // m along the view, rows from the top; infinite where nothing is
  };
  Image TakeDepth();
};

class SegmentationCamera : public Sensor {
 public:
  static constexpr const char* kType = "segmentation_camera";
  using Sensor::Sensor;

  // A pixel of label n shows names[n - 1], one of label 0 nothing. Rows from the top.
  struct Image {
    int width = 0, height = 0;
    std::vector<std::uint32_t> labels;
    std::vector<std::string> names;
  };
  Image Segment();
};

class BoundingBoxCamera : public Sensor {
 public:
  static constexpr const char* kType = "boundingbox_camera";
  using Sensor::Sensor;

  // Pixels from the picture's upper left corner.
  struct Box {
    std::string name;
    double left = 0, top = 0, right = 0, bottom = 0;
  };
  std::vector<Box> Detect();
};

}  // namespace gsv
