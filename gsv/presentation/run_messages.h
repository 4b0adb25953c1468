// Converts the status and events of a run to messages: for the viewer, and as a log and diagnostics
// for ROS tools.
#pragma once

#include "gsv/messages/diagnostic_msgs.h"
#include "gsv/messages/gsv_msgs.h"
#include "gsv/messages/rcl_interfaces.h"
#include "gsv/simulation/types.h"

namespace gsv::presentation {

messages::gsv_msgs::SimulationStatus StatusMessage(const simulation::SimulationStatus& status);
messages::gsv_msgs::LifecycleEvent EventMessage(const simulation::Event& event);

// Returns an event as a log message. Its name is the robot, or "gsv" if the event concerns no
// robot. For a line that a behaviour prints, the text is the line, and `file` is the stream. Its
// level is information for stdout, and warning for stderr. A dead behaviour, a program that ends
// without exit code 0, a failed simulation and a violated expectation are errors. An unresponsive
// or silent behaviour and a moved robot are warnings.
messages::rcl_interfaces::Log LogMessage(const simulation::Event& event);

// Returns the diagnostics of the simulation, followed by those of each robot, ordered by name. The
// simulation has an error if it has failed, and a warning while it is blocked. A robot has an error
// if its behaviour has died, and a warning while it is unresponsive.
messages::diagnostic_msgs::DiagnosticArray DiagnosticsMessage(
    const simulation::SimulationStatus& status);

}  // namespace gsv::presentation
