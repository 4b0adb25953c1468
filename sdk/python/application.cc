// Robotic applications in Python: simulations on servers that are offered through a broker.
#include <pybind11/stl.h>

#include "sdk/application.h"
#include "sdk/python/factory.h"

namespace gsv::python {
namespace {

using Options = std::map<std::string, std::string>;

class PythonSimulation {
 public:
  explicit PythonSimulation(std::unique_ptr<RemoteSimulation> simulation)
      : simulation_(std::move(simulation)) {}

  RemoteSimulation& Get() const {
    if (simulation_ == nullptr)
      Raise({base::ErrorCode::kEnded, "the simulation has been destroyed", ""});
    return *simulation_;
  }
  void Destroy() { simulation_.reset(); }

 private:
  std::unique_ptr<RemoteSimulation> simulation_;
};

// Adds a robot. `behaviour` is the name of an offer, a class or another callable that makes a
// behaviour, or None.
std::string Add(const PythonSimulation& simulation, const std::string& model, double x, double y,
                double yaw, const py::object& behaviour, const std::string& name) {
  RobotRequest request{model, x, y, yaw, "", name, {}};
  if (py::isinstance<py::str>(behaviour)) {
    request.behaviour = behaviour.cast<std::string>();
  } else if (!behaviour.is_none()) {
    request.own_behaviour = FactoryFrom(behaviour);
  }
  const py::gil_scoped_release release;
  return ValueOrRaise(simulation.Get().AddRobot(request));
}

// Runs until the instant. Ends early after a signal, with the exception that Python raises for this
// signal.
void RunUntil(const PythonSimulation& simulation, double instant, double patience) {
  const base::SimTime until = TimeFrom(instant);
  const auto limit = std::chrono::duration_cast<std::chrono::seconds>(TimeFrom(patience));
  bool interrupted = false;
  base::Status status;
  {
    const py::gil_scoped_release release;
    status = simulation.Get().RunUntil(until, limit, [&interrupted] {
      const py::gil_scoped_acquire gil;
      interrupted = PyErr_CheckSignals() != 0;
      return !interrupted;
    });
  }
  if (interrupted) throw py::error_already_set();
  ValueOrRaise(std::move(status));
}

// Calls a member of RemoteSimulation without the GIL.
template <typename T, typename... Arguments>
auto Calling(base::Result<T> (RemoteSimulation::*member)(Arguments...)) {
  return [member](const PythonSimulation& simulation, Arguments... arguments) {
    return ValueOrRaise((simulation.Get().*member)(arguments...));
  };
}

void BindState(py::module_& module) {
  py::class_<RobotState>(module, "RobotState", "The state of a robot in the simulation.")
      .def_readonly("name", &RobotState::name)
      .def_readonly("model", &RobotState::model)
      .def_readonly("behaviour", &RobotState::behaviour)
      .def_readonly(
          "agent", &RobotState::agent,
          "state of the behaviour: \"running\", \"waiting\", \"finished\", \"unresponsive\", "
          "\"dead\", …")
      .def_readonly("place", &RobotState::place, "pose of the robot in the world")
      .def_readonly("distance", &RobotState::distance, "driven distance in m")
      .def_readonly("collisions", &RobotState::collisions)
      .def("__repr__", [](const RobotState& r) {
        return py::str("<robot \"{}\" at ({:.3f}, {:.3f}), {}, {:.2f} m, {} collisions>")
            .format(r.name, r.place.x, r.place.y, r.agent, r.distance, r.collisions);
      });
  py::class_<SimulationState>(module, "SimulationState",
                              "The state of a simulation and its robots at one instant.")
      .def_readonly("phase", &SimulationState::phase, "\"created\", \"running\", \"paused\", …")
      .def_property_readonly(
          "time", [](const SimulationState& s) { return SecondsOf(s.time); }, "simulated time in s")
      .def_readonly("real_time_factor", &SimulationState::real_time_factor)
      .def_readonly("late_steps", &SimulationState::late_steps)
      .def_readonly("waiting_for", &SimulationState::waiting_for,
                    "the behaviour that the simulation waits for; empty if there is none")
      .def_readonly("failure", &SimulationState::failure)
      .def_property_readonly(
          "robots",
          [](const SimulationState& state) {
            py::dict robots;
            for (const RobotState& robot : state.robots) robots[py::str(robot.name)] = robot;
            return robots;
          },
          "a dict of RobotState by name")
      .def("__repr__", [](const SimulationState& s) {
        return py::str("<{} at {:.3f} s, {} robots>")
            .format(s.phase, SecondsOf(s.time), s.robots.size());
      });
}

// Converts numbers, flags and texts to the form of sba::NameValue.
std::string TextOf(const py::handle& value) {
  if (py::isinstance<py::bool_>(value)) return value.cast<bool>() ? "true" : "false";
  return py::str(value);
}

void Command(const PythonSimulation& simulation, const std::string& name,
             const py::kwargs& keywords) {
  std::map<std::string, std::string> arguments;
  for (const auto& [key, value] : keywords) arguments[py::str(key)] = TextOf(value);
  const py::gil_scoped_release release;
  ValueOrRaise(simulation.Get().Command(name, arguments));
}

Owned<PythonSimulation> Create(Application& application, const std::string& world,
                               const std::string& constraint, const std::string& preference,
                               bool lockstep, double factor, double step, std::uint64_t seed,
                               const std::string& name, const Options& options) {
  const SimulationRequest request{world, lockstep, factor, TimeFrom(step), seed, name, options};
  const py::gil_scoped_release release;
  return Owned<PythonSimulation>(
      new PythonSimulation(ValueOrRaise(application.Create(request, constraint, preference))));
}

}  // namespace

void BindApplications(py::module_& module) {
  BindState(module);
  py::class_<Application, Owned<Application>>(module, "Application")
      .def(py::init([](const std::string& broker) {
             const py::gil_scoped_release release;
             return Owned<Application>(ValueOrRaise(Application::Connect(broker)).release());
           }),
           py::arg("broker"));
  py::class_<PythonSimulation, Owned<PythonSimulation>>(
      module, "Simulation",
      "A simulation on a server. The server destroys it when this object is deleted.")
      .def(py::init(&Create), py::arg("application"), py::arg("world"), py::arg("constraint"),
           py::arg("preference"), py::arg("lockstep"), py::arg("factor"), py::arg("step"),
           py::arg("seed"), py::arg("name"), py::arg("options"))
      .def("add", &Add, py::arg("model"), py::arg("x") = 0.0, py::arg("y") = 0.0,
           py::arg("yaw") = 0.0, py::arg("behaviour") = py::none(), py::arg("name") = "",
           "Adds a robot and returns its name. `behaviour` is the name of an offer, a class of "
           "behaviours (or a callable that returns one) to run in this process, or None.")
      .def("remove", Calling(&RemoteSimulation::RemoveRobot), py::arg("name"), LetOthersRun())
      .def("start", Calling(&RemoteSimulation::Start), LetOthersRun())
      .def("pause", Calling(&RemoteSimulation::Pause), LetOthersRun())
      .def("resume", Calling(&RemoteSimulation::Resume), LetOthersRun())
      .def("stop", Calling(&RemoteSimulation::Stop), LetOthersRun())
      .def("reset", Calling(&RemoteSimulation::Reset), LetOthersRun(),
           "Resets the simulation to its start, with the same robots.")
      .def("set_factor", Calling(&RemoteSimulation::SetRealTimeFactor), py::arg("factor"),
           LetOthersRun(),
           "Sets the target real-time factor from the next step on. Raises Refused in lockstep.")
      .def("command", &Command, py::arg("name"),
           "Executes a command of the simulator with named arguments: "
           "command(\"step\", count=10).")
      .def("run_until", &RunUntil, py::arg("instant"), py::kw_only(), py::arg("patience") = 600.0,
           "Runs until the simulated time `instant` (in seconds), and pauses. Blocks until then, "
           "but at most `patience` seconds of wall-clock time.")
      .def("state", Calling(&RemoteSimulation::State), LetOthersRun(),
           "Returns the current state of the simulation and its robots.")
      .def("state_hash", Calling(&RemoteSimulation::StateHash), LetOthersRun(),
           "Returns a hash of the state. Equal runs have equal hashes.")
      .def("viewer_url", Calling(&RemoteSimulation::ViewerUrl), LetOthersRun(),
           "Returns the address of the viewer, or an empty text if the server has no viewer.")
      .def("start_recording", Calling(&RemoteSimulation::StartRecording), py::arg("path"),
           LetOthersRun(), "Starts recording to a file on the machine of the simulator.")
      .def("stop_recording", Calling(&RemoteSimulation::StopRecording), LetOthersRun())
      .def("destroy", &PythonSimulation::Destroy, LetOthersRun());
}

}  // namespace gsv::python
