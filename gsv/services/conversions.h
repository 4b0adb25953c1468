// Converts GSV's data structures to IDL types, and IDL types to GSV's.
#pragma once

#include <initializer_list>
#include <map>
#include <string>
#include <string_view>

#include "gsv/geometry/pose.h"
#include "gsv/health/health.h"
#include "gsv/model/sensor_description.h"
#include "gsv/sensing/reading.h"
#include "gsv/simulation/commands/command.h"
#include "gsv/simulation/types.h"
#include "idl/simulation.hh"

namespace gsv::services {

sba::Placement ToIdl(const geometry::Pose& pose);
geometry::Pose FromIdl(const sba::Placement& placement);

// `robot_from_link` is the pose of the sensor's link in the robot's frame.
sba::SensorTraits ToIdl(const model::SensorDescription& description,
                        const geometry::Pose& robot_from_link);
// Converts texts to parameters, and recognises numbers and flags.
model::Parameters FromIdl(const sba::NameValues& values);
sba::NameValues ToIdl(const model::Parameters& parameters);
// Throws sba::Refused for an unknown option. The reason lists the known options.
void RefuseUnknown(const model::Parameters& options, std::initializer_list<std::string_view> known);

sba::CommandDescription ToIdl(const simulation::Command& command);
// Returns the values by name, unparsed: the type of a command's parameter is needed to parse its
// value. If a name occurs twice, the last value applies.
std::map<std::string, std::string> TextsOf(const sba::NameValues& values);

sba::Measurement ToIdl(const std::string& sensor, const sensing::Reading& reading);

sba::SimulationState ToIdl(const simulation::SimulationStatus& status);
// Members that the IDL does not have (wall-clock times, numbers of readings, avatars) keep their
// defaults.
simulation::SimulationStatus FromIdl(const sba::SimulationState& state);
sba::RobotHealths ToIdl(const health::Report& report);
// Converts lines of output (simulation::IsOutput()). If `robot` is not empty, returns only the
// lines of this robot or behaviour.
sba::OutputLines OutputToIdl(const std::vector<simulation::Event>& lines, std::string_view robot);
sba::SimulationPhase ToIdl(simulation::Phase phase);
simulation::Phase FromIdl(sba::SimulationPhase phase);

}  // namespace gsv::services
