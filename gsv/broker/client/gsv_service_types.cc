#include "gsv/broker/client/gsv_service_types.h"

namespace gsv::broker {
namespace {

PropertyDefinition Text(std::string name, PropertyMode mode) {
  return {std::move(name), {Scalar::kString, false, {}, {}}, mode};
}

PropertyDefinition Number(std::string name, PropertyMode mode) {
  return {std::move(name), {Scalar::kLong, false, {}, {}}, mode};
}

PropertyDefinition Flag(std::string name, PropertyMode mode) {
  return {std::move(name), {Scalar::kBoolean, false, {}, {}}, mode};
}

void TakeText(const PropertyList& properties, const char* name, std::string& text) {
  const Value* value = properties.Find(name);
  if (value == nullptr) return;
  if (const auto found = value->AsText()) text = *found;
}

void TakeNumber(const PropertyList& properties, const char* name, std::int32_t& number) {
  const Value* value = properties.Find(name);
  if (value == nullptr) return;
  if (const auto found = value->AsInteger()) number = static_cast<std::int32_t>(*found);
}

}  // namespace

const ServiceType& AgentBehaviourFactoryType() {
  static const ServiceType type{
      .name = "gsv::AgentBehaviourFactory",
      .interface_name = "IDL:gsv/sba/AgentBehaviourFactory:1.0",
      .properties = {Text("name", PropertyMode::kMandatory),
                     Text("description", PropertyMode::kNormal),
                     Text("host", PropertyMode::kMandatoryReadonly),
                     Number("pid", PropertyMode::kMandatoryReadonly),
                     Flag("time_managed", PropertyMode::kMandatoryReadonly)}};
  return type;
}

const ServiceType& SimulationServiceType() {
  static const ServiceType type{.name = "gsv::SimulationService",
                                .interface_name = "IDL:gsv/sba/SimulationService:1.0",
                                .properties = {Text("name", PropertyMode::kMandatory),
                                               Text("host", PropertyMode::kMandatoryReadonly),
                                               Number("pid", PropertyMode::kMandatoryReadonly),
                                               Text("viewer_url", PropertyMode::kNormal),
                                               Number("simulations", PropertyMode::kNormal),
                                               Number("cores", PropertyMode::kNormal)}};
  return type;
}

const ServiceType& ScenarioServiceType() {
  static const ServiceType type{.name = "gsv::ScenarioService",
                                .interface_name = "IDL:gsv/sba/ScenarioService:1.0",
                                .properties = {Text("name", PropertyMode::kMandatory),
                                               Text("host", PropertyMode::kMandatoryReadonly),
                                               Number("pid", PropertyMode::kMandatoryReadonly),
                                               Number("slots", PropertyMode::kMandatory),
                                               Number("cores", PropertyMode::kNormal)}};
  return type;
}

std::vector<Property> PropertiesOf(const BehaviourOffer& offer) {
  return {{"name", Value::String(offer.name)},
          {"description", Value::String(offer.description)},
          {"host", Value::String(offer.host)},
          {"pid", Value::Long(offer.pid)},
          {"time_managed", Value::Boolean(offer.time_managed)}};
}

BehaviourOffer BehaviourOfferFrom(const PropertyList& properties) {
  BehaviourOffer offer;
  TakeText(properties, "name", offer.name);
  TakeText(properties, "description", offer.description);
  TakeText(properties, "host", offer.host);
  TakeNumber(properties, "pid", offer.pid);
  if (const Value* managed = properties.Find("time_managed")) {
    offer.time_managed = managed->AsBoolean().value_or(offer.time_managed);
  }
  return offer;
}

std::vector<Property> PropertiesOf(const SimulationServiceOffer& offer) {
  return {{"name", Value::String(offer.name)},
          {"host", Value::String(offer.host)},
          {"pid", Value::Long(offer.pid)},
          {"viewer_url", Value::String(offer.viewer_url)},
          {"cores", Value::Long(offer.cores)}};
}

std::vector<Property> PropertiesOf(const ScenarioServiceOffer& offer) {
  return {{"name", Value::String(offer.name)},
          {"host", Value::String(offer.host)},
          {"pid", Value::Long(offer.pid)},
          {"slots", Value::Long(offer.slots)},
          {"cores", Value::Long(offer.cores)}};
}

ScenarioServiceOffer ScenarioServiceOfferFrom(const PropertyList& properties) {
  ScenarioServiceOffer offer;
  TakeText(properties, "name", offer.name);
  TakeText(properties, "host", offer.host);
  TakeNumber(properties, "pid", offer.pid);
  TakeNumber(properties, "slots", offer.slots);
  TakeNumber(properties, "cores", offer.cores);
  return offer;
}

}  // namespace gsv::broker
