// The robot of a behaviour in Python.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "sdk/behaviour/sonar_ring.h"
#include "sdk/python/kinds.h"
#include "sdk/remote_robot.h"

namespace gsv::python {
namespace {

using sdk::RemoteRobot;

// Makes an object of the class for the sensor's type, or a Sensor if the type has no class.
py::object MakeSensor(std::unique_ptr<SensorPort> port) {
  const auto maker = SensorMakers().find(port->traits().type);
  return maker != SensorMakers().end() ? maker->second(std::move(port))
                                       : MakeSensorOf<Sensor>(std::move(port));
}

py::object OpenSensor(RemoteRobot& robot, const std::string& name, const py::object& kind) {
  base::Result<std::unique_ptr<SensorPort>> port;
  {
    const py::gil_scoped_release release;
    port = robot.OpenPort(name);
  }
  py::object sensor = MakeSensor(ValueOrRaise(std::move(port)));
  if (!kind.is_none() && !py::isinstance(sensor, kind)) {
    Raise({base::ErrorCode::kInvalidArgument,
           "the sensor \"" + name + "\" is not of the class " +
               py::str(kind.attr("__name__")).cast<std::string>(),
           robot.name()});
  }
  return sensor;
}

// Creates a sensor. `type` is the name of a sensor type, or a class with the attribute TYPE.
py::object CreateSensor(RemoteRobot& robot, const py::object& type, const std::string& name,
                        const Placement& robot_from_sensor, Parameters parameters,
                        double update_rate) {
  const py::object type_name = py::isinstance<py::str>(type) ? type : type.attr("TYPE");
  SensorTraits traits{name, type_name.cast<std::string>(), robot_from_sensor, update_rate,
                      std::move(parameters)};
  base::Result<std::unique_ptr<SensorPort>> port;
  {
    const py::gil_scoped_release release;
    port = robot.CreatePort(std::move(traits));
  }
  return MakeSensor(ValueOrRaise(std::move(port)));
}

// Returns readings by the names of the sensors, or None after the end of the run.
py::object Exchange(RemoteRobot& robot, double linear, double angular, double until,
                    double lateral) {
  std::vector<Reading> readings;
  bool running = false;
  {
    const py::gil_scoped_release release;
    running = robot.Exchange({linear, angular, lateral}, TimeFrom(until), readings);
  }
  if (!running) return py::none();
  py::dict by_name;
  for (Reading& reading : readings) {
    const py::str name(reading.sensor);
    by_name[name] = py::cast(std::move(reading));
  }
  return by_name;
}

SonarRing OpenRing(RemoteRobot& robot, int count) {
  return ValueOrRaise(SonarRing::Open(robot, count));
}

std::vector<SonarRing::Echo> EchoesFrom(const SonarRing& ring, const py::dict& readings) {
  std::vector<Reading> copies;
  for (const auto& [name, reading] : readings) copies.push_back(reading.cast<const Reading&>());
  return ring.From(copies);
}

void BindRing(py::module_& module) {
  py::class_<SonarRing> ring(module, "SonarRing",
                             "Evenly spaced sonars around a robot: the sonars of its model, or new "
                             "sonars if the model has none.");
  py::class_<SonarRing::Echo>(ring, "Echo")
      .def_readonly("bearing", &SonarRing::Echo::bearing,
                    "direction of the sonar, rad, counter-clockwise from straight ahead")
      .def_readonly("distance", &SonarRing::Echo::distance,
                    "distance of the echo from the robot's origin, m")
      .def_readonly("in_reach", &SonarRing::Echo::in_reach,
                    "False if there is no echo within the sonar's maximum range");
  ring.def(py::init(&OpenRing), py::arg("robot"), py::arg("count"), py::keep_alive<1, 2>(),
           LetOthersRun())
      .def("read", &SonarRing::Read, LetOthersRun(),
           "Reads all sonars, one after the other, and returns their echoes.")
      .def("from_readings", &EchoesFrom, py::arg("readings"),
           "Returns the echoes of this ring's sonars in the readings of Robot.exchange().");
  module.def("nearest", &Nearest, py::arg("echoes"), py::arg("bearing"), py::arg("half_angle"),
             "Returns the smallest distance in m of the echoes within half_angle of bearing (rad), "
             "including those out of reach; inf if there are none.");
}

void BindJoints(py::module_& module) {
  py::class_<JointTraits>(
      module, "JointTraits",
      "Name, kind and limits of a joint: rad, rad/s and N m. Prismatic joints: m, m/s and N.")
      .def_readonly("name", &JointTraits::name)
      .def_readonly("kind", &JointTraits::kind)
      .def_readonly("min_position", &JointTraits::min_position)
      .def_readonly("max_position", &JointTraits::max_position)
      .def_readonly("max_velocity", &JointTraits::max_velocity)
      .def_readonly("max_effort", &JointTraits::max_effort);
  py::class_<JointState>(
      module, "JointState",
      "Position and velocity of a joint at one instant: rad and rad/s, or m and m/s.")
      .def_property_readonly("time", [](const JointState& s) { return SecondsOf(s.time); })
      .def_readonly("position", &JointState::position)
      .def_readonly("velocity", &JointState::velocity);
  py::class_<Joint>(module, "Joint",
                    "A joint that accepts commands. A command applies until the next command.")
      .def_property_readonly("traits", &Joint::traits)
      .def("move_to", &Joint::MoveTo, py::arg("position"), LetOthersRun())
      .def("move_at", &Joint::MoveAt, py::arg("velocity"), LetOthersRun())
      .def("apply", &Joint::Apply, py::arg("effort"), LetOthersRun())
      .def("release", &Joint::Release, LetOthersRun())
      .def("read", &Joint::Read, LetOthersRun());
}

}  // namespace

void BindRobot(py::module_& module) {
  BindJoints(module);
  py::class_<RemoteRobot, std::shared_ptr<RemoteRobot>>(
      module, "Robot",
      "The robot that a behaviour drives. After the end of the run every call returns at once and "
      "does nothing. Times are in simulated seconds. Use a robot in one thread only.")
      .def_property_readonly("name", &RemoteRobot::name)
      .def_property_readonly(
          "footprint_radius", &RemoteRobot::footprint_radius,
          "radius in m of a circle around the robot's origin that contains the whole robot")
      .def("sensors", &RemoteRobot::Sensors, LetOthersRun(),
           "Returns the descriptions of the sensors of the robot's model.")
      .def("open", &OpenSensor, py::arg("name"), py::arg("kind") = py::none(),
           py::keep_alive<0, 1>(),
           "Opens a sensor of the robot's model and returns an object of the class for its type. "
           "Raises Refused if the object is not of the class `kind`.")
      .def(
          "create", &CreateSensor, py::arg("type"), py::arg("name"),
          py::arg("robot_from_sensor") = Placement{}, py::arg("parameters") = Parameters{},
          py::arg("update_rate") = 0.0, py::keep_alive<0, 1>(),
          "Creates a sensor that is mounted on the base. `type` is a class or the name of a sensor "
          "type. docs/sensors.md lists the parameters of each type.")
      .def("joints", &RemoteRobot::Joints, LetOthersRun(),
           "Returns the descriptions of the joints that accept commands.")
      .def(
          "open_joint",
          [](RemoteRobot& robot, const std::string& name) {
            return ValueOrRaise(robot.OpenJoint(name));
          },
          py::arg("name"), py::keep_alive<0, 1>(), LetOthersRun())
      .def(
          "drive",
          [](RemoteRobot& robot, double linear, double angular, double lateral) {
            robot.Command({linear, angular, lateral});
          },
          py::arg("linear"), py::arg("angular"), py::arg("lateral") = 0.0, LetOthersRun(),
          "Commands the velocity of the base in m/s and rad/s. The command applies until the next "
          "command, or until the drive's command timeout. `lateral` is the velocity to the left, "
          "for bases that can move sideways.")
      .def(
          "now", [](RemoteRobot& robot) { return SecondsOf(robot.Now()); }, LetOthersRun(),
          "Returns the time of the robot's clock in simulated seconds.")
      .def(
          "sleep_until",
          [](RemoteRobot& robot, double instant) { return robot.SleepUntil(TimeFrom(instant)); },
          py::arg("instant"), LetOthersRun(),
          "Sleeps until the simulated time `instant` (in seconds). Returns False if the run has "
          "ended.")
      .def(
          "sleep_for",
          [](RemoteRobot& robot, double duration) { return robot.SleepFor(TimeFrom(duration)); },
          py::arg("duration"), LetOthersRun(),
          "Sleeps for `duration` simulated seconds. Returns False if the run has ended.")
      .def("exchange", &Exchange, py::arg("linear"), py::arg("angular"), py::arg("until"),
           py::arg("lateral") = 0.0,
           "Performs one control cycle in one round trip: commands the base, sleeps until the "
           "instant `until`, then reads all open sensors. Returns a dict of Reading by sensor "
           "name, or None "
           "if the run has ended.")
      .def_property_readonly("is_running", &RemoteRobot::IsRunning)
      .def_property_readonly(
          "error", &RemoteRobot::error,
          "the reason why the run ended; empty during the run and after a normal end");
  BindRing(module);
}

}  // namespace gsv::python
