#include "sdk/python/values.h"

#include <cmath>
#include <stdexcept>

namespace gsv::python {
namespace {

constexpr double kMaxSeconds = 9e9;  // s

const char* ExceptionFor(base::ErrorCode code) {
  switch (code) {
    case base::ErrorCode::kInvalidArgument:
      return "Refused";
    case base::ErrorCode::kBadModel:
      return "BadModel";
    case base::ErrorCode::kBehaviour:
      return "BehaviourFailed";
    case base::ErrorCode::kNotFound:
      return "NotFound";
    case base::ErrorCode::kUnavailable:
      return "Unavailable";
    case base::ErrorCode::kTimeout:
      return "TimedOut";
    case base::ErrorCode::kNotRunning:
      return "NotRunning";
    case base::ErrorCode::kEnded:
      return "Ended";
    case base::ErrorCode::kCorrupt:
      return "Corrupt";
  }
  return "Error";
}

}  // namespace

void Raise(const base::Error& error) {
  const py::gil_scoped_acquire gil;
  const py::object type = py::module_::import("gsv.errors").attr(ExceptionFor(error.code));
  PyErr_SetString(type.ptr(), error.Sentence().c_str());
  throw py::error_already_set();
}

base::SimTime TimeFrom(double seconds) {
  if (!(std::abs(seconds) < kMaxSeconds)) {
    throw py::value_error("expected a time in seconds, found " + std::to_string(seconds));
  }
  return base::FromSeconds(seconds);
}

namespace {

// Returns " in wander.py line 12", the innermost frame of a traceback; empty without a traceback.
std::string PlaceOf(const py::object& trace) {
  if (trace.is_none()) return {};
  const py::list frames = py::module_::import("traceback").attr("extract_tb")(trace);
  if (frames.empty()) return {};
  const py::object frame = frames[frames.size() - 1];
  const auto file = frame.attr("filename").cast<std::string>();
  const auto line = py::str(frame.attr("lineno")).cast<std::string>();
  return " in " + file.substr(file.rfind('/') + 1) + " line " + line;
}

}  // namespace

void CallPython(const std::function<void()>& call) {
  const py::gil_scoped_acquire gil;
  std::string raised;
  try {
    call();
    return;
  } catch (const py::error_already_set& error) {
    // The text is like the last line of the traceback, such as "ZeroDivisionError: division by
    // zero".
    raised = py::str(error.type().attr("__name__")).cast<std::string>() + ": " +
             py::str(error.value()).cast<std::string>();
    const py::object trace = error.trace() ? error.trace() : py::none();
    raised += PlaceOf(trace);
    py::module_::import("traceback").attr("print_exception")(error.type(), error.value(), trace);
  }
  throw std::runtime_error(raised);
}

}  // namespace gsv::python
