// A robot as its behaviour sees it: sensors by name, a base to drive, a clock to wait on. Whether
// it is simulated, and where, does not show.
//
// Frames   REP-103: x forward, y left, z up.
// Units    metres, radians, seconds.
// Errors   after the end of the run every call returns at once and does nothing: readings come
//          back empty or at their maximum, waits return false. error() says what went wrong.
// Threads  one behaviour, one thread.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/base/sim_time.h"

namespace gsv {

using base::SimTime;
using namespace std::chrono_literals;  // robot.SleepFor(50ms)

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

struct SensorTraits {
  std::string name;
  std::string type;
  Placement robot_from_sensor;
};

class Sonar {
 public:
  virtual ~Sonar() = default;
  // m to the nearest echo; max_range() when there is none.
  virtual double Range() = 0;
  virtual double max_range() const = 0;
};

class Camera {
 public:
  virtual ~Camera() = default;
  virtual Picture TakePicture() = 0;
};

class PositioningSystem {
 public:
  virtual ~PositioningSystem() = default;
  virtual Placement Locate() = 0;  // world_from_robot
};

struct DriveCommand {
  double linear = 0;   // m/s
  double angular = 0;  // rad/s
};

// One sensor's reading in a control cycle; the shape of `values` is its type's.
struct Reading {
  std::string sensor;
  SimTime time{0};
  std::vector<double> values;
};

class Robot {
 public:
  virtual ~Robot() = default;

  virtual const std::string& name() const = 0;
  // m: a circle of this radius about the robot's origin holds all of it.
  virtual double footprint_radius() const = 0;
  virtual std::vector<SensorTraits> Sensors() = 0;

  // A sensor of the robot's model; an error when it is not there or of another kind.
  virtual base::Result<std::unique_ptr<Sonar>> OpenSonar(const std::string& sensor) = 0;
  virtual base::Result<std::unique_ptr<Camera>> OpenCamera(const std::string& sensor) = 0;
  // Any sensor, to be read by Exchange().
  virtual base::Status OpenSensor(const std::string& sensor) = 0;

  // Further sensors, mounted on the base.
  virtual base::Result<std::unique_ptr<Sonar>> CreateSonar(const std::string& sensor,
                                                           const Placement& robot_from_sonar,
                                                           double min_range, double max_range) = 0;
  virtual base::Result<std::unique_ptr<Camera>> CreateCamera(const std::string& sensor,
                                                             const Placement& robot_from_camera,
                                                             int width, int height,
                                                             double horizontal_fov) = 0;
  virtual base::Result<std::unique_ptr<PositioningSystem>> CreatePositioningSystem(
      const std::string& sensor) = 0;

  // Acts until the next command.
  virtual void Drive(double linear, double angular) = 0;

  virtual SimTime Now() = 0;
  // False when the run has ended; the behaviour then returns.
  virtual bool SleepUntil(SimTime instant) = 0;
  bool SleepFor(SimTime duration) { return SleepUntil(Now() + duration); }
  // One control cycle in one round trip: drives, sleeps until `instant`, then reads every open
  // sensor. False when the run has ended.
  virtual bool Exchange(const DriveCommand& command, SimTime instant,
                        std::vector<Reading>& readings) = 0;

  virtual bool IsRunning() const = 0;
  // Why it is not running; empty while it is, and after an ordinary end.
  virtual std::string error() const = 0;
};

}  // namespace gsv
