// The service types under which GSV offers its own services; docs/services.md lists them in a
// table.
#pragma once

#include <string>

#include "gsv/broker/language/property.h"
#include "gsv/broker/offers/service_type.h"

namespace gsv::broker {

// The type for sba::AgentBehaviourFactory.
const ServiceType& AgentBehaviourFactoryType();
// The type for sba::SimulationService.
const ServiceType& SimulationServiceType();
// The type for sba::ScenarioService.
const ServiceType& ScenarioServiceType();

// The properties of an offer of type AgentBehaviourFactoryType().
struct BehaviourOffer {
  std::string name;  // the name of the behaviour, such as "wander"
  std::string description;
  std::string host;
  std::int32_t pid = 0;  // id of the process that serves the behaviour
  // True if the behaviour uses only the simulation's clock. In lockstep, the simulation waits for
  // such a behaviour. A behaviour that uses the wall clock cannot run in lockstep.
  bool time_managed = true;
};
std::vector<Property> PropertiesOf(const BehaviourOffer& offer);
// Reads an offer. Properties that are missing keep their defaults.
BehaviourOffer BehaviourOfferFrom(const PropertyList& properties);

// The properties of an offer of type SimulationServiceType().
struct SimulationServiceOffer {
  std::string name;  // the name of the server
  std::string host;
  std::int32_t pid = 0;    // id of the server's process
  std::string viewer_url;  // empty if the server has no viewer
  std::int32_t cores = 1;  // number of the machine's processor cores
};
std::vector<Property> PropertiesOf(const SimulationServiceOffer& offer);

// `slots` is the number of scenarios that the server runs at once.
struct ScenarioServiceOffer {
  std::string name;  // the name of the server
  std::string host;
  std::int32_t pid = 0;    // id of the server's process
  std::int32_t slots = 0;  // number of scenarios that the server runs at once
  std::int32_t cores = 1;  // number of the machine's processor cores
};
std::vector<Property> PropertiesOf(const ScenarioServiceOffer& offer);
// Reads an offer. Properties that are missing keep their defaults.
ScenarioServiceOffer ScenarioServiceOfferFrom(const PropertyList& properties);

}  // namespace gsv::broker
