// The interface through which a behaviour uses its robot: sensors by name, a base to drive, and a
// clock to wait on. The interface is the same for simulated robots in this process, simulated
// robots in other processes, and real robots.
//
// Frames   REP-103: x forward, y left, z up.
// Units    metres, radians, seconds.
// Errors   after the end of the run every call returns at once and does nothing. Readings are empty
//          or at their maximum, and waits return false. error() returns the reason.
// Threads  one behaviour, one thread.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/base/sim_time.h"
#include "sdk/behaviour/actuators.h"
#include "sdk/behaviour/joint.h"
#include "sdk/behaviour/sensors.h"

namespace gsv {

using namespace std::chrono_literals;  // for durations such as in robot.SleepFor(50ms)

// The commanded velocity of the base, in its own frame.
struct DriveCommand {
  double linear = 0;   // m/s
  double angular = 0;  // rad/s
  double lateral = 0;  // m/s to the left; ignored by bases that cannot move sideways
};

// A robot, as its behaviour sees it.
class Robot {
 public:
  virtual ~Robot() = default;

  virtual const std::string& name() const = 0;
  // The radius in m of a circle about the robot's origin that contains the robot.
  virtual double footprint_radius() const = 0;
  // Returns the sensors of the robot's model, and the sensors that were created.
  virtual std::vector<SensorTraits> Sensors() = 0;

  // Opens a sensor of the robot's model. Fails if it does not exist or has another type.
  template <typename Kind>
  base::Result<std::unique_ptr<Kind>> Open(const std::string& sensor);
  // Opens a sensor of any type for Exchange().
  base::Status OpenSensor(const std::string& sensor);

  // Creates a sensor, mounted on the base. docs/sensors.md lists the parameters of each type.
  template <typename Kind>
  base::Result<std::unique_ptr<Kind>> Create(const std::string& sensor,
                                             const Placement& robot_from_sensor,
                                             Parameters parameters = {}, double update_rate = 0);

  base::Result<std::unique_ptr<Sonar>> OpenSonar(const std::string& sensor) {
    return Open<Sonar>(sensor);
  }
  base::Result<std::unique_ptr<Camera>> OpenCamera(const std::string& sensor) {
    return Open<Camera>(sensor);
  }
  base::Result<std::unique_ptr<Radio>> OpenRadio(const std::string& sensor) {
    return Open<Radio>(sensor);
  }
  base::Result<std::unique_ptr<Sonar>> CreateSonar(const std::string& sensor,
                                                   const Placement& robot_from_sonar,
                                                   double min_range, double max_range) {
    return Create<Sonar>(sensor, robot_from_sonar, {{"min", min_range}, {"max", max_range}});
  }
  base::Result<std::unique_ptr<Camera>> CreateCamera(const std::string& sensor,
                                                     const Placement& robot_from_camera, int width,
                                                     int height, double horizontal_fov);
  base::Result<std::unique_ptr<PositioningSystem>> CreatePositioningSystem(
      const std::string& sensor) {
    return Create<PositioningSystem>(sensor, {});
  }

  // Returns the joints that accept commands. OpenJoint() opens one of them by name.
  virtual std::vector<JointTraits> Joints() = 0;
  virtual base::Result<std::unique_ptr<Joint>> OpenJoint(const std::string& joint) = 0;

  // Commands the base. The command applies until the next one, or until the drive's command timeout
  // (<command_timeout> in the model file). A velocity that is NaN or infinite is not applied: the
  // call throws std::invalid_argument, and the behaviour may continue.
  virtual void Command(const DriveCommand& command) = 0;
  // Commands the velocities along x (m/s) and about z (rad/s).
  void Drive(double linear, double angular) { Command({linear, angular}); }
  // Drives a mecanum or omnidirectional base. `lateral` is to the left.
  void DriveSideways(double linear, double lateral, double angular) {
    Command({linear, angular, lateral});
  }

  // Returns the time of the robot's clock. In a simulation, it is 0 at the start.
  virtual SimTime Now() = 0;
  // Sleeps until the instant. Returns false after the end of the run. The behaviour must then
  // return.
  virtual bool SleepUntil(SimTime instant) = 0;
  // Sleeps for this duration, see SleepUntil().
  bool SleepFor(SimTime duration) { return SleepUntil(Now() + duration); }
  // Does one control cycle in one round trip: commands the base, sleeps until `instant`, then reads
  // every open sensor. Returns false after the end of the run.
  virtual bool Exchange(const DriveCommand& command, SimTime instant,
                        std::vector<Reading>& readings) = 0;

  virtual bool IsRunning() const = 0;  // false after the end of the run
  // The reason for the end of the run. Empty during the run and after a normal end.
  virtual std::string error() const = 0;

 private:
  // Opens a sensor that the robot's model already has.
  virtual base::Result<std::unique_ptr<SensorPort>> OpenPort(const std::string& sensor) = 0;
  // Adds a new sensor, which `traits` describes, to the robot, and opens it.
  virtual base::Result<std::unique_ptr<SensorPort>> CreatePort(SensorTraits traits) = 0;
};

template <typename Kind>
base::Result<std::unique_ptr<Kind>> Robot::Open(const std::string& sensor) {
  auto port = OpenPort(sensor);
  if (!port) return base::Fail(port.error());
  const std::string& type = (*port)->traits().type;
  bool is_of_kind = type == Kind::kType;
  if constexpr (requires { Kind::Is(type); }) is_of_kind = Kind::Is(type);
  if (!is_of_kind) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "the sensor \"" + sensor + "\" is no " + Kind::kType, name());
  }
  return std::make_unique<Kind>(*std::move(port));
}

template <typename Kind>
base::Result<std::unique_ptr<Kind>> Robot::Create(const std::string& sensor,
                                                  const Placement& robot_from_sensor,
                                                  Parameters parameters, double update_rate) {
  auto port =
      CreatePort({sensor, Kind::kType, robot_from_sensor, update_rate, std::move(parameters)});
  if (!port) return base::Fail(port.error());
  return std::make_unique<Kind>(*std::move(port));
}

inline base::Status Robot::OpenSensor(const std::string& sensor) {
  const auto port = OpenPort(sensor);
  return port ? base::Status{} : base::Fail(port.error());
}

inline base::Result<std::unique_ptr<Camera>> Robot::CreateCamera(const std::string& sensor,
                                                                 const Placement& robot_from_camera,
                                                                 int width, int height,
                                                                 double horizontal_fov) {
  return Create<Camera>(sensor, robot_from_camera,
                        {{"image.width", static_cast<double>(width)},
                         {"image.height", static_cast<double>(height)},
                         {"horizontal_fov", horizontal_fov}});
}

}  // namespace gsv
