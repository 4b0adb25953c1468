// Lamps, grippers, speakers and microphones. A refused command raises an exception.
#include "sdk/behaviour/actuators.h"

#include "sdk/python/kinds.h"

namespace gsv::python {
namespace {

// Commands an actuator without the GIL, and raises its error.
template <typename Call>
void RunCommand(const Call& call) {
  base::Status status;
  {
    const py::gil_scoped_release release;
    status = call();
  }
  ValueOrRaise(std::move(status));
}

void BindLamp(py::module_& module, py::class_<Sensor>& sensor) {
  py::class_<Colour>(module, "Colour", "A colour: red, green and blue, each from 0 to 1.")
      .def(py::init<double, double, double>(), py::arg("red") = 1.0, py::arg("green") = 1.0,
           py::arg("blue") = 1.0)
      .def_readonly("red", &Colour::red)
      .def_readonly("green", &Colour::green)
      .def_readonly("blue", &Colour::blue)
      .def("__iter__",
           [](const Colour& c) { return py::iter(py::make_tuple(c.red, c.green, c.blue)); })
      .def("__repr__", [](const Colour& c) {
        return py::str("Colour(red={:.3g}, green={:.3g}, blue={:.3g})")
            .format(c.red, c.green, c.blue);
      });
  auto lamp = BindKind<Lamp>(module, "Lamp", sensor, "A lamp, or an LED.");
  lamp.def(
          "set",
          [](Lamp& self, const Colour& colour, double brightness) {
            RunCommand([&] { return self.Set(colour, brightness); });
          },
          py::arg("colour") = Colour{}, py::arg("brightness") = 1.0,
          "Sets the colour and the brightness (0 to 1).")
      .def(
          "switch_off", [](Lamp& self) { RunCommand([&] { return self.SwitchOff(); }); },
          "Switches the lamp off.")
      .def("read", &Lamp::Read, LetOthersRun(), "Returns the brightness and the colour.");
  BindReading<Lamp::Glow>(lamp, "Glow");
  Deprecate(lamp, "shine", "set");
  Deprecate(lamp, "look", "read");
}

void BindGripper(py::module_& module, py::class_<Sensor>& sensor) {
  auto gripper = BindKind<Gripper>(module, "Gripper", sensor, "Two fingers that grasp a body.");
  gripper
      .def(
          "grasp", [](Gripper& self) { RunCommand([&] { return self.Grasp(); }); },
          "Closes the fingers. A dynamic body between the fingers is attached until they open.")
      .def(
          "open", [](Gripper& self) { RunCommand([&] { return self.Open(); }); },
          "Opens the fingers and detaches the body.")
      .def("read", &Gripper::Read, LetOthersRun(),
           "Returns the opening in m, and the name of the grasped body.");
  BindReading<Gripper::State>(gripper, "State");
  Deprecate(gripper, "grip", "grasp");
  Deprecate(gripper, "let_go", "open");
  Deprecate(gripper, "feel", "read");
  Deprecate(gripper, "Jaws", "State");
}

void BindSound(py::module_& module, py::class_<Sensor>& sensor) {
  auto speaker =
      BindKind<Speaker>(module, "Speaker", sensor, "Plays sounds, which microphones hear.");
  speaker
      .def(
          "play",
          [](Speaker& self, const std::string& sound, double frequency, double duration,
             double volume) {
            RunCommand([&] { return self.Play(sound, frequency, duration, volume); });
          },
          py::arg("sound"), py::arg("frequency"), py::arg("duration"), py::arg("volume") = 1.0,
          "Plays \"tone\", \"buzz\", \"chirp\" or \"noise\". Frequency in Hz, duration in s, "
          "volume from 0 to 1.")
      .def(
          "beep",
          [](Speaker& self, double frequency, double duration) {
            RunCommand([&] { return self.Beep(frequency, duration); });
          },
          py::arg("frequency") = 880.0, py::arg("duration") = 0.2,
          "Plays a tone. Frequency in Hz, duration in s.")
      .def(
          "silence", [](Speaker& self) { RunCommand([&] { return self.Silence(); }); },
          "Stops the sound.")
      .def("playing", &Speaker::Playing, LetOthersRun(), "Returns the sound that is playing.");
  BindReading<Speaker::Sound>(speaker, "Sound");
  auto microphone = BindKind<Microphone>(module, "Microphone", sensor,
                                         "Measures the sound level and the loudest sound.");
  microphone.def("listen", &Microphone::Listen, LetOthersRun(),
                 "Returns the sound level in dB, and frequency and source of the loudest sound.");
  BindReading<Microphone::Hearing>(microphone, "Hearing");
}

}  // namespace

void BindActuators(py::module_& module, py::class_<Sensor>& sensor) {
  BindLamp(module, sensor);
  BindGripper(module, sensor);
  BindSound(module, sensor);
}

}  // namespace gsv::python
