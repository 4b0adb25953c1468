// Sensors and their readings. Arrays are views of the readings and keep them alive. Only the labels
// of a segmentation camera are copied between the SDK and NumPy.
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include "sdk/python/kinds.h"

namespace gsv::python {
namespace {

using Doubles = py::array_t<double>;

// Returns the values of a reading as an array that keeps the reading alive.
Doubles AllValues(const py::object& reading) {
  const std::vector<double>& values = reading.cast<const Reading&>().values;
  return Doubles(static_cast<py::ssize_t>(values.size()), values.data(), reading);
}

// Measures without the GIL; Python owns the reading.
py::object Measured(Sensor& sensor) {
  Reading reading;
  {
    const py::gil_scoped_release release;
    reading = sensor.TakeReading();
  }
  return py::cast(std::move(reading));
}

py::array_t<std::uint8_t> ToArray(Image image) {
  auto kept = std::make_unique<Image>(std::move(image));
  const Image& of = *kept;
  const py::capsule owner(kept.release(), [](void* memory) { delete static_cast<Image*>(memory); });
  return py::array_t<std::uint8_t>({of.height, of.width, 3}, of.rgb.data(), owner);
}

// Returns the values of a reading as a struct. After the end of the run, the struct is empty.
template <typename Values>
Values ValuesIn(Sensor& sensor, const Reading& reading) {
  return sensor.In<Values>(reading).value_or(Values());
}

// A view of a part of the values of a reading.
Doubles PartOf(const py::object& reading, std::span<const double> part) {
  return Doubles(static_cast<py::ssize_t>(part.size()), part.data(), reading);
}

py::tuple ReadLidar(Lidar& lidar) {
  const py::object reading = Measured(lidar);
  auto scan = ValuesIn<readings::Lidar>(lidar, reading.cast<const Reading&>());
  const auto& parameters = lidar.traits().parameters;
  const auto found = parameters.find(readings::Lidar::kIntensityParameter);
  const double* const scale =
      found == parameters.end() ? nullptr : std::get_if<double>(&found->second);
  if (scale != nullptr && *scale > 0) scan = scan.WithIntensities();
  return py::make_tuple(PartOf(reading, scan.ranges), PartOf(reading, scan.intensities));
}

Doubles TakeDepth(DepthCamera& camera) {
  const py::object reading = Measured(camera);
  const auto image = ValuesIn<readings::DepthImage>(camera, reading.cast<const Reading&>());
  return Doubles({image.height, image.width}, image.depth.data(), reading);
}

Doubles TakeTemperatures(ThermalCamera& camera) {
  const py::object reading = Measured(camera);
  const auto image = ValuesIn<readings::ThermalImage>(camera, reading.cast<const Reading&>());
  return Doubles({image.height, image.width}, image.temperature.data(), reading);
}

Doubles TakeNormals(NormalsCamera& camera) {
  const py::object reading = Measured(camera);
  const auto image = ValuesIn<readings::NormalImage>(camera, reading.cast<const Reading&>());
  return Doubles({image.height, image.width, 3}, image.normals.data(), reading);
}

py::tuple Segment(SegmentationCamera& camera) {
  const py::object reading = Measured(camera);
  const auto image = ValuesIn<readings::SegmentedImage>(camera, reading.cast<const Reading&>());
  py::array_t<std::uint32_t> labels({image.height, image.width});
  std::copy(image.pixels.begin(), image.pixels.end(), labels.mutable_data());
  return py::make_tuple(labels, std::vector<std::string>(image.names.begin(), image.names.end()));
}

void BindPlainData(py::module_& module) {
  py::class_<Placement>(module, "Placement",
                        "A pose: position in m, and roll, pitch and yaw about fixed axes in rad.")
      .def(py::init<double, double, double, double, double, double>(), py::arg("x") = 0.0,
           py::arg("y") = 0.0, py::arg("z") = 0.0, py::arg("roll") = 0.0, py::arg("pitch") = 0.0,
           py::arg("yaw") = 0.0)
      .def_readwrite("x", &Placement::x)
      .def_readwrite("y", &Placement::y)
      .def_readwrite("z", &Placement::z)
      .def_readwrite("roll", &Placement::roll)
      .def_readwrite("pitch", &Placement::pitch)
      .def_readwrite("yaw", &Placement::yaw)
      .def("__repr__", [](const Placement& p) {
        return py::str(
                   "Placement(x={:.3f}, y={:.3f}, z={:.3f}, roll={:.3f}, pitch={:.3f}, "
                   "yaw={:.3f})")
            .format(p.x, p.y, p.z, p.roll, p.pitch, p.yaw);
      });
  BindReading<readings::Quaternion>(module, "Quaternion", "A rotation as a unit quaternion.");
  BindReading<Vector>(module, "Vector", "Three components along x, y and z.")
      .def("__iter__", [](const Vector& v) { return py::iter(py::make_tuple(v.x, v.y, v.z)); })
      .def("__repr__", [](const Vector& v) {
        return py::str("Vector(x={:.6g}, y={:.6g}, z={:.6g})").format(v.x, v.y, v.z);
      });
  py::class_<SensorTraits>(module, "SensorTraits",
                           "The description of a sensor; see docs/sensors.md.")
      .def_readonly("name", &SensorTraits::name)
      .def_readonly("type", &SensorTraits::type, "\"sonar\", \"camera\", …")
      .def_readonly("robot_from_sensor", &SensorTraits::robot_from_sensor)
      .def_readonly("update_rate", &SensorTraits::update_rate,
                    "rate of new readings in Hz; 0 if each request makes a new reading")
      .def_readonly("parameters", &SensorTraits::parameters)
      .def("__repr__",
           [](const SensorTraits& t) { return py::str("<{} \"{}\">").format(t.type, t.name); });
  py::class_<Reading>(module, "Reading", "A sensor's measurement at one instant.")
      .def_readonly("sensor", &Reading::sensor)
      .def_property_readonly(
          "time", [](const Reading& r) { return SecondsOf(r.time); }, "simulated time in s")
      .def_property_readonly(
          "values", &AllValues,
          "numpy.float64, as a view; docs/sensors.md has the layout for each type")
      .def_readonly("labels", &Reading::labels,
                    "names that belong to the values, such as names of joints")
      .def("__repr__", [](const Reading& r) {
        return py::str("<{} values of \"{}\" at {:.3f} s>")
            .format(r.values.size(), r.sensor, SecondsOf(r.time));
      });
}

void BindRangeAndVision(py::module_& module, py::class_<Sensor>& sensor) {
  BindKind<Sonar>(module, "Sonar", sensor, "Measures the distance to the nearest object in a cone.")
      .def("range", &Sonar::Range, LetOthersRun(),
           "Returns the distance to the nearest echo in m, or max_range if there is no echo.")
      .def_property_readonly("max_range", &Sonar::max_range);
  BindKind<Lidar>(module, "Lidar", sensor, "A laser scanner, with one or more rows of beams.")
      .def(
          "ranges", [](Lidar& lidar) -> py::object { return ReadLidar(lidar)[0]; },
          "Returns the range of each beam in m (numpy.float64); inf if the beam hit nothing, "
          "-inf if it hit something nearer than the minimum range.")
      .def("read", &ReadLidar,
           "Returns (ranges, intensities) of one scan. intensities is empty without the parameter "
           "intensity_scale.");
  SensorMakers()[Camera::kWideAngleType] = MakeSensorOf<Camera>;
  auto camera = BindKind<Camera>(module, "Camera", sensor, "Takes images.");
  camera.def(
      "take_image",
      [](Camera& self) {
        Image image;
        {
          const py::gil_scoped_release release;
          image = self.TakeImage();
        }
        return ToArray(std::move(image));
      },
      "Returns an RGB image: numpy.uint8 of the shape (height, width, 3), rows from the top.");
  Deprecate(camera, "take_picture", "take_image");
  BindKind<DepthCamera>(module, "DepthCamera", sensor, "Measures the depth of each pixel.")
      .def("take_depth", &TakeDepth,
           "Returns the depth along the optical axis in m: numpy.float64 of the shape (height, "
           "width); inf if there is no surface.");
  BindKind<ThermalCamera>(module, "ThermalCamera", sensor,
                          "Measures the temperature of each pixel.")
      .def("take_temperatures", &TakeTemperatures,
           "Returns temperatures in K: numpy.float64 of the shape (height, width), in whole steps "
           "of the resolution.");
  BindKind<NormalsCamera>(module, "NormalsCamera", sensor,
                          "Measures the surface normal at each pixel.")
      .def("take_normals", &TakeNormals,
           "Returns unit normals in the sensor frame, towards the camera: numpy.float64 of the "
           "shape (height, width, 3); NaN where the normal is unknown.");
  BindKind<SegmentationCamera>(module, "SegmentationCamera", sensor,
                               "Labels each pixel with the model that it shows.")
      .def("segment", &Segment,
           "Returns (labels, names). labels is numpy.uint32 of the shape (height, width). A pixel "
           "with label n shows names[n - 1], and label 0 is the background.");
  auto boxes = BindKind<BoundingBoxCamera>(module, "BoundingBoxCamera", sensor,
                                           "Finds the models in its image.");
  boxes.def("detect", &BoundingBoxCamera::Detect, LetOthersRun(),
            "Returns the bounding boxes of the visible models.");
  BindReading<BoundingBoxCamera::Box>(
      boxes, "Box", "A bounding box, in pixels from the upper left corner of the image.");
  auto logical = BindKind<LogicalCamera>(module, "LogicalCamera", sensor,
                                         "Lists the models in its field of view.");
  logical.def("read", &LogicalCamera::Read, LetOthersRun(),
              "Returns the visible models with their poses.");
  Deprecate(logical, "look", "read");
  BindReading<LogicalCamera::Sighting>(logical, "Sighting");
}

void BindMotion(py::module_& module, py::class_<Sensor>& sensor) {
  BindKind<PositioningSystem>(module, "PositioningSystem", sensor,
                              "Measures the pose of the sensor in the world.")
      .def("locate", &PositioningSystem::Locate, LetOthersRun(),
           "Returns the pose of the sensor in the world.");
  auto imu = BindKind<Imu>(module, "Imu", sensor, "Measures angular velocity and specific force.");
  imu.def("read", &Imu::Read, LetOthersRun());
  Deprecate(imu, "feel", "read");
  BindReading<Imu::Motion>(
      imu, "Motion",
      "Angular velocity and specific force in the sensor's frame. At rest, the force points up.");
  auto odometer = BindKind<Odometer>(module, "Odometer", sensor,
                                     "Estimates the pose from the wheels (dead reckoning).");
  odometer.def("read", &Odometer::Read, LetOthersRun());
  Deprecate(odometer, "reckon", "read");
  BindReading<Odometer::Estimate>(
      odometer, "Estimate",
      "The pose relative to the start pose of the robot, and the velocities.");
  auto gnss = BindKind<GnssReceiver>(module, "GnssReceiver", sensor,
                                     "Receives satellite navigation signals.");
  gnss.def("fix", &GnssReceiver::Fix, LetOthersRun());
  BindReading<GnssReceiver::Position>(
      gnss, "Position",
      "A position in WGS84 (degrees, m), and the velocity east, north and up (m/s).");
  Deprecate(module, "SatelliteReceiver", "GnssReceiver");
  BindKind<Magnetometer>(module, "Magnetometer", sensor, "Measures the magnetic field.")
      .def("field", &Magnetometer::Field, LetOthersRun(),
           "Returns the field in the sensor's frame, in tesla.");
  auto altimeter = BindKind<Altimeter>(
      module, "Altimeter", sensor,
      "Measures the height above the reference height, and the vertical speed.");
  altimeter.def("measured", &Altimeter::Measured, LetOthersRun());
  BindReading<Altimeter::Height>(altimeter, "Height",
                                 "Height above the reference in m, and vertical speed in m/s.");
}

void BindBody(py::module_& module, py::class_<Sensor>& sensor) {
  auto bumper = BindKind<Bumper>(module, "Bumper", sensor, "Reports the robot's contacts.");
  bumper.def("is_pressed", &Bumper::IsPressed, LetOthersRun())
      .def("touches", &Bumper::Touches, LetOthersRun());
  BindReading<Bumper::Touch>(
      bumper, "Touch",
      "A contact, in the sensor's frame. The normal points from the robot to the other body.");
  auto force_torque = BindKind<ForceTorque>(
      module, "ForceTorque", sensor, "Measures the force and torque that a joint transmits.");
  force_torque.def("read", &ForceTorque::Read, LetOthersRun());
  BindReading<ForceTorque::Wrench>(force_torque, "Wrench",
                                   "Force in N and torque in N m, about the joint's origin.");
  auto encoders =
      BindKind<JointEncoders>(module, "JointEncoders", sensor,
                              "Measures the positions and velocities of the robot's joints.");
  encoders.def("joints", &JointEncoders::Joints, LetOthersRun());
  BindReading<JointEncoders::Joint>(
      encoders, "Joint", "Position and velocity of one joint: rad and rad/s, or m and m/s.");
  auto battery =
      BindKind<Battery>(module, "Battery", sensor, "Measures the charge of the battery.");
  battery.def("level", &Battery::Level, LetOthersRun());
  BindReading<Battery::Charge>(
      battery, "Charge",
      "Voltage in V, drawn current in A, charge and capacity in Ah, and fraction (0 to 1).");
  BindKind<Ranging>(module, "Ranging", sensor, "Measures the distance to one radio anchor.")
      .def("distance", &Ranging::Distance, LetOthersRun(),
           "Returns the distance in m; inf if the anchor is not received.");
  auto radio = BindKind<Radio>(module, "Radio", sensor,
                               "Sends messages to other robots and receives their messages.");
  const auto send = [](Radio& from, const std::string& receiver, const std::string& content) {
    base::Status sent;
    {
      const py::gil_scoped_release release;
      sent = from.Send(receiver, content);
    }
    ValueOrRaise(std::move(sent));
  };
  radio
      .def("send", send, py::arg("receiver"), py::arg("content"),
           "Sends a message to the robot `receiver`, without a confirmation of its reception.")
      .def(
          "broadcast", [send](Radio& from, const std::string& content) { send(from, "", content); },
          py::arg("content"), "Sends a message to all robots in range.")
      .def("receive", &Radio::Receive, LetOthersRun(),
           "Returns the messages that were received since the last call, the oldest first.")
      .def_property_readonly("missed", &Radio::missed,
                             "number of messages that were lost because the inbox was full");
  py::class_<Radio::Message>(radio, "Message")
      .def_readonly("sender", &Radio::Message::sender)
      .def_property_readonly(
          "content", [](const Radio::Message& message) { return py::bytes(message.content); })
      .def_property_readonly(
          "sent", [](const Radio::Message& message) { return SecondsOf(message.sent); },
          "simulated time of sending, s")
      .def_readonly("strength", &Radio::Message::strength, "received signal strength, dBm");
}

}  // namespace

std::map<std::string, SensorMaker>& SensorMakers() {
  static std::map<std::string, SensorMaker> makers;
  return makers;
}

void BindSensors(py::module_& module) {
  BindPlainData(module);
  py::class_<Sensor> sensor(
      module, "Sensor",
      "The base class of all sensors. After the end of a run, readings have no values.");
  sensor.def_property_readonly("traits", &Sensor::traits)
      .def_property_readonly("name", [](const Sensor& s) { return s.traits().name; })
      .def("measure", &Measured, "Takes a Reading and returns it.")
      .def("__repr__", [](const Sensor& s) {
        return py::str("<{} \"{}\">").format(s.traits().type, s.traits().name);
      });
  BindRangeAndVision(module, sensor);
  BindMotion(module, sensor);
  BindBody(module, sensor);
  BindActuators(module, sensor);
}

}  // namespace gsv::python
