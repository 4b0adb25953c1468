// Our plain data to and from that of the IDL.
#pragma once

#include <initializer_list>
#include <map>
#include <string>
#include <string_view>

#include "gsv/geometry/pose.h"
#include "gsv/model/sensor_description.h"
#include "gsv/sensing/reading.h"
#include "gsv/simulation/commands/command.h"
#include "gsv/simulation/types.h"
#include "idl/simulation.hh"

namespace gsv::services {

sba::Placement ToIdl(const geometry::Pose& pose);
geometry::Pose FromIdl(const sba::Placement& placement);

// `robot_from_link` places the sensor's link.
sba::SensorTraits ToIdl(const model::SensorDescription& description,
                        const geometry::Pose& robot_from_link);
// Numbers and flags are recognised in the parameters' text.
model::Parameters FromIdl(const sba::NameValues& values);
sba::NameValues ToIdl(const model::Parameters& parameters);
// Raises sba::Refused, naming those that are known, for an option that is none of them.
void RefuseUnknown(const model::Parameters& options, std::initializer_list<std::string_view> known);

sba::CommandDescription ToIdl(const simulation::Command& command);
// GSV reads each as the type of the parameter that it is for. Of two with one name the last counts.
std::map<std::string, std::string> TextsOf(const sba::NameValues& values);

sba::Measurement ToIdl(const std::string& sensor, const sensing::Reading& reading);

sba::SimulationState ToIdl(const simulation::SimulationStatus& status);
// What the IDL does not carry (wall times, counts of readings, who is an avatar) keeps its default.
simulation::SimulationStatus FromIdl(const sba::SimulationState& state);
sba::SimulationPhase ToIdl(simulation::Phase phase);
simulation::Phase FromIdl(sba::SimulationPhase phase);

}  // namespace gsv::services
