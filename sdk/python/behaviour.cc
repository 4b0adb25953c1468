// Behaviours in Python: a behaviour is any object with init(robot) and run(robot).
#include <sys/prctl.h>

#include <csignal>

#include "sdk/offered_behaviour.h"
#include "sdk/python/factory.h"
#include "sdk/remote_robot.h"

namespace gsv::python {
namespace {

class PythonBehaviour final : public Behaviour {
 public:
  explicit PythonBehaviour(SharedObject object) : object_(std::move(object)) {}

  base::Status Init(Robot& robot) override {
    CallPython([&] { object_->attr("init")(ForPython(robot)); });
    return {};
  }
  void Run(Robot& robot) override {
    CallPython([&] { object_->attr("run")(ForPython(robot)); });
  }
  void Paused() override { CallListener("paused"); }
  void Resumed() override { CallListener("resumed"); }

 private:
  void CallListener(const char* event) {
    CallPython([&] {
      if (py::hasattr(*object_, event)) object_->attr(event)();
    });
  }
  // Returns the robot as a Python object, which Python may keep for any time.
  static py::object ForPython(Robot& robot) {
    return py::cast(dynamic_cast<sdk::RemoteRobot&>(robot).shared_from_this());
  }

  const SharedObject object_;
};

class Offer {
 public:
  Offer(const std::string& broker, BehaviourDescription description, const py::object& make) {
    BehaviourFactory factory = FactoryFrom(make);
    const py::gil_scoped_release release;
    offered_ = ValueOrRaise(OfferedBehaviour::Offer(broker, description, std::move(factory)));
    broker_ = offered_->broker();
  }
  void Withdraw() { offered_.reset(); }
  const std::string& broker() const { return broker_; }

 private:
  std::unique_ptr<OfferedBehaviour> offered_;
  std::string broker_;
};

}  // namespace

BehaviourFactory FactoryFrom(const py::object& make) {
  if (PyCallable_Check(make.ptr()) == 0) {
    throw py::type_error("expected a class of behaviours, or a callable that returns a behaviour");
  }
  return [kept = SharedObject(make)]() -> std::unique_ptr<Behaviour> {
    std::unique_ptr<Behaviour> behaviour;
    CallPython([&] { behaviour = std::make_unique<PythonBehaviour>(SharedObject((*kept)())); });
    return behaviour;
  };
}

void BindBehaviours(py::module_& module) {
  py::class_<Offer, Owned<Offer>>(
      module, "Offer",
      "A behaviour that this program offers through a broker until it is withdrawn.")
      .def(py::init([](const std::string& broker, const std::string& name, const py::object& make,
                       const std::string& description, bool time_managed) {
             return Owned<Offer>(new Offer(broker, {name, description, time_managed}, make));
           }),
           py::arg("broker"), py::arg("name"), py::arg("make"), py::arg("description") = "",
           py::arg("time_managed") = true)
      .def_property_readonly("broker", &Offer::broker, "address of the broker")
      .def("withdraw", &Offer::Withdraw, LetOthersRun());
  module.def(
      "end_with_parent", [] { prctl(PR_SET_PDEATHSIG, SIGTERM); },
      "Ends this process when the process that started it ends.");
}

}  // namespace gsv::python
