// Conversions that all bindings use: errors to exceptions, times to seconds, and Python objects
// that are kept by threads without the interpreter's lock (GIL).
//
// Threads  the caller holds the GIL unless a function's comment says otherwise. Functions that wait
//          release it.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>

#include <pybind11/pybind11.h>

#include "gsv/base/error.h"
#include "gsv/base/sim_time.h"

namespace gsv::python {

namespace py = pybind11;

// Releases the GIL during a bound function, so that other Python threads can run.
using LetOthersRun = py::call_guard<py::gil_scoped_release>;

// Raises the exception of gsv.errors for the error's code, with its sentence. The caller may or may
// not hold the GIL.
[[noreturn]] void Raise(const base::Error& error);

template <typename T>
T ValueOrRaise(base::Result<T> result) {
  if (!result) Raise(result.error());
  if constexpr (!std::is_void_v<T>) return *std::move(result);
}

// Raises ValueError if `seconds` is not a valid time. Needs no GIL.
base::SimTime TimeFrom(double seconds);

// Returns the double that is nearest to the time in seconds, such as 0.15. ToSeconds() may return a
// neighbour of this double.
inline double SecondsOf(base::SimTime time) { return static_cast<double>(time.count()) / 1e9; }

// A Python object that threads may copy, keep and destroy without holding the GIL.
class SharedObject {
 public:
  explicit SharedObject(py::object object)
      : object_(new py::object(std::move(object)), [](py::object* last) {
          const py::gil_scoped_acquire gil;
          delete last;
        }) {}
  const py::object& operator*() const { return *object_; }
  const py::object* operator->() const { return object_.get(); }

 private:
  std::shared_ptr<py::object> object_;
};

// Runs `call`, which uses Python, on a thread of this library with the GIL held. Prints the
// traceback of a Python exception to stderr and throws a std::runtime_error with one line.
void CallPython(const std::function<void()>& call);

// Deletes objects without the GIL held. This deleter is for objects whose destructors wait for
// other threads.
struct EndsWithoutGil {
  template <typename T>
  void operator()(T* object) const {
    const py::gil_scoped_release release;
    delete object;
  }
};
template <typename T>
using Owned = std::unique_ptr<T, EndsWithoutGil>;

void BindSensors(py::module_& module);
void BindRobot(py::module_& module);  // call it after BindSensors()
void BindBehaviours(py::module_& module);
void BindApplications(py::module_& module);

}  // namespace gsv::python
