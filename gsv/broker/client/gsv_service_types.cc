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

std::vector<Property> PropertiesOf(const BehaviourOffer& offer) {
  return {{"name", Value::String(offer.name)},
          {"description", Value::String(offer.description)},
          {"host", Value::String(offer.host)},
          {"pid", Value::Long(offer.pid)},
          {"time_managed", Value::Boolean(offer.time_managed)}};
}

BehaviourOffer BehaviourOfferFrom(const PropertyList& properties) {
  BehaviourOffer offer;
  const auto text = [&](const char* name, std::string& out) {
    const Value* value = properties.Find(name);
    if (value == nullptr) return;
    if (const auto* found = value->As<std::string>()) out = *found;
  };
  text("name", offer.name);
  text("description", offer.description);
  text("host", offer.host);
  if (const Value* pid = properties.Find("pid");
      pid != nullptr && pid->As<std::int64_t>() != nullptr) {
    offer.pid = static_cast<std::int32_t>(*pid->As<std::int64_t>());
  }
  if (const Value* managed = properties.Find("time_managed");
      managed != nullptr && managed->As<bool>() != nullptr) {
    offer.time_managed = *managed->As<bool>();
  }
  return offer;
}

std::vector<Property> PropertiesOf(const SimulationServiceOffer& offer) {
  return {{"name", Value::String(offer.name)},
          {"host", Value::String(offer.host)},
          {"pid", Value::Long(offer.pid)},
          {"viewer_url", Value::String(offer.viewer_url)},
          {"simulations", Value::Long(offer.simulations)},
          {"cores", Value::Long(offer.cores)}};
}

}  // namespace gsv::broker
