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
    Raise(
        {base::ErrorCode::kInvalidArgument,
         "the sensor \"" + name + "\" is no " + py::str(kind.attr("__name__")).cast<std::string>(),
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
  py::class_<SonarRing> ring(
      module, "SonarRing",
      "Evenly spaced sonars around a robot: those of its model, or created ones if it has none.");
  py::class_<SonarRing::Echo>(ring, "Echo")
      .def_readonly("bearing", &SonarRing::Echo::bearing,
                    "rad, counter-clockwise from straight ahead")
      .def_readonly("distance", &SonarRing::Echo::distance, "m from the robot's origin")
      .def_readonly("in_reach", &SonarRing::Echo::in_reach,
                    "False: no echo up to the sonar's maximum range");
  ring.def(py::init(&OpenRing), py::arg("robot"), py::arg("count"), py::keep_alive<1, 2>(),
           LetOthersRun())
      .def("read", &SonarRing::Read, LetOthersRun(), "Reads the sonars one after the other.")
      .def("from_readings", &EchoesFrom, py::arg("readings"),
           "Returns the readings of the ring from the readings of an exchange.");
  module.def("nearest", &Nearest, py::arg("echoes"), py::arg("bearing"), py::arg("half_angle"),
             "The distance to the nearest echo within half_angle of bearing; inf without an echo.");
}

void BindJoints(py::module_& module) {
  py::class_<JointTraits>(module, "JointTraits", "rad, rad/s and N m, or m, m/s and N.")
      .def_readonly("name", &JointTraits::name)
      .def_readonly("kind", &JointTraits::kind)
      .def_readonly("min_position", &JointTraits::min_position)
      .def_readonly("max_position", &JointTraits::max_position)
      .def_readonly("max_velocity", &JointTraits::max_velocity)
      .def_readonly("max_effort", &JointTraits::max_effort);
  py::class_<JointState>(module, "JointState", "rad and rad/s, or m and m/s, at an instant.")
      .def_property_readonly("time", [](const JointState& s) { return SecondsOf(s.time); })
      .def_readonly("position", &JointState::position)
      .def_readonly("velocity", &JointState::velocity);
  py::class_<Joint>(module, "Joint",
                    "A joint that accepts commands. A command applies until the next one.")
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
      "A robot as its behaviour sees it. After the end of the run every call returns at once and "
      "does nothing. Times are simulated seconds. One thread.")
      .def_property_readonly("name", &RemoteRobot::name)
      .def_property_readonly(
          "footprint_radius", &RemoteRobot::footprint_radius,
          "m: radius of a circle around the origin that contains the whole robot")
      .def("sensors", &RemoteRobot::Sensors, LetOthersRun(), "the sensors of the robot's model")
      .def("open", &OpenSensor, py::arg("name"), py::arg("kind") = py::none(),
           py::keep_alive<0, 1>(),
           "Returns a sensor of the robot's model, as an object of the class of its type. `kind` "
           "is the expected class.")
      .def("create", &CreateSensor, py::arg("type"), py::arg("name"),
           py::arg("robot_from_sensor") = Placement{}, py::arg("parameters") = Parameters{},
           py::arg("update_rate") = 0.0, py::keep_alive<0, 1>(),
           "Creates a sensor, mounted on the base. `type` is a class or a name; its parameters are "
           "those of docs/sensors.md.")
      .def("joints", &RemoteRobot::Joints, LetOthersRun(), "the joints that accept commands")
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
          "Commands the base, in m/s and rad/s, until the next command. `lateral` is to the left, "
          "for "
          "bases that can move sideways.")
      .def(
          "now", [](RemoteRobot& robot) { return SecondsOf(robot.Now()); }, LetOthersRun(),
          "simulated seconds")
      .def(
          "sleep_until",
          [](RemoteRobot& robot, double instant) { return robot.SleepUntil(TimeFrom(instant)); },
          py::arg("instant"), LetOthersRun(), "False when the run has ended")
      .def(
          "sleep_for",
          [](RemoteRobot& robot, double duration) { return robot.SleepFor(TimeFrom(duration)); },
          py::arg("duration"), LetOthersRun(), "False when the run has ended")
      .def("exchange", &Exchange, py::arg("linear"), py::arg("angular"), py::arg("until"),
           py::arg("lateral") = 0.0,
           "One control cycle in one round trip: drives, sleeps until that instant, then reads "
           "every open sensor. Returns a dict of Reading by sensor name, or None when the run has "
           "ended.")
      .def_property_readonly("is_running", &RemoteRobot::IsRunning)
      .def_property_readonly(
          "error", &RemoteRobot::error,
          "the reason why it does not run; empty while it runs and after a normal end");
  BindRing(module);
}

}  // namespace gsv::python
