// How a run goes, as messages: for our viewer, and for ROS's own tools the same as a log and as
// diagnostics.
#pragma once

#include "gsv/messages/diagnostic_msgs.h"
#include "gsv/messages/gsv_msgs.h"
#include "gsv/messages/rcl_interfaces.h"
#include "gsv/simulation/types.h"

namespace gsv::presentation {

messages::gsv_msgs::SimulationStatus StatusMessage(const simulation::SimulationStatus& status);
messages::gsv_msgs::LifecycleEvent EventMessage(const simulation::Event& event);

// An event as a line of a log: from the robot or, where it tells of the simulation, from "gsv".
// An error when a behaviour or the simulation has failed, a warning when something did not go as
// it was asked to.
messages::rcl_interfaces::Log LogMessage(const simulation::Event& event);

// The simulation first, then each robot, by name. Of the simulation: an error when it has failed, a
// warning while it is held up. Of a robot: an error when its behaviour has died, a warning while
// that does not answer.
messages::diagnostic_msgs::DiagnosticArray DiagnosticsMessage(
    const simulation::SimulationStatus& status);

}  // namespace gsv::presentation
