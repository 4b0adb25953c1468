// The service types under which GSV offers its own services; docs/services.md lists them in a
// table.
#pragma once

#include <string>

#include "gsv/broker/language/property.h"
#include "gsv/broker/offers/service_type.h"

namespace gsv::broker {

// sba::AgentBehaviourFactory.
const ServiceType& AgentBehaviourFactoryType();
// sba::SimulationService.
const ServiceType& SimulationServiceType();
// sba::ScenarioService.
const ServiceType& ScenarioServiceType();

struct BehaviourOffer {
  std::string name;  // "wander"
  std::string description;
  std::string host;
  std::int32_t pid = 0;
  bool time_managed = true;  // it uses the robot's clock: the simulation may wait for it
};
std::vector<Property> PropertiesOf(const BehaviourOffer& offer);
// Properties that are missing keep their defaults.
BehaviourOffer BehaviourOfferFrom(const PropertyList& properties);

struct SimulationServiceOffer {
  std::string name;  // of the server
  std::string host;
  std::int32_t pid = 0;
  std::string viewer_url;  // empty: it has no viewer
  std::int32_t cores = 1;
};
std::vector<Property> PropertiesOf(const SimulationServiceOffer& offer);

// `slots` is the number of scenarios that the server runs at once.
struct ScenarioServiceOffer {
  std::string name;  // of the server
  std::string host;
  std::int32_t pid = 0;
  std::int32_t slots = 0;
  std::int32_t cores = 1;
};
std::vector<Property> PropertiesOf(const ScenarioServiceOffer& offer);
// Properties that are missing keep their defaults.
ScenarioServiceOffer ScenarioServiceOfferFrom(const PropertyList& properties);

}  // namespace gsv::broker
