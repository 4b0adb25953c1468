#include <ostream>

#include <nlohmann/json.hpp>

#include "gsv/broker/client/offer_listing.h"

namespace gsv::broker {
namespace {

using OrderedJson = nlohmann::ordered_json;

std::string Line(const OrderedJson& json) {
  return json.dump(-1, ' ', false, OrderedJson::error_handler_t::replace) + "\n";
}

OrderedJson ToJson(const ScalarValue& value) {
  return std::visit([](const auto& content) { return OrderedJson(content); }, value);
}

OrderedJson ToJson(const Value& value) {
  if (const OtherValue* other = value.AsOther()) {
    if (other->promised_type != nullptr) return {{"dynamic", other->promised_type->Spelling()}};
    return {{"type", other->type_name}};
  }
  if (const Value::Sequence* sequence = value.AsSequence()) {
    OrderedJson array = OrderedJson::array();
    for (const ScalarValue& element : *sequence) array.push_back(ToJson(element));
    return array;
  }
  if (const auto truth = value.AsBoolean()) return *truth;
  if (const auto integer = value.AsInteger()) return *integer;
  if (const auto real = value.AsReal()) return *real;
  return *value.AsText();
}

OrderedJson ToJson(const PropertyDefinition& definition) {
  return {{"name", definition.name},
          {"type", definition.type.Spelling()},
          {"readonly", IsReadonly(definition.mode)},
          {"mandatory", IsMandatory(definition.mode)}};
}

}  // namespace

void PrintOffers(const std::vector<OfferDescription>& offers, std::ostream& out) {
  for (const OfferDescription& offer : offers) {
    out << offer.id << "  " << offer.type << "  " << offer.address << "\n";
    for (const auto& [name, value] : offer.properties) {
      const std::string line = Line(ToJson(value));
      out << "  " << name << " = " << line;
    }
  }
}

void PrintServiceTypes(const std::vector<ServiceType>& types, std::ostream& out) {
  for (const ServiceType& type : types) {
    out << type.name << (type.masked ? "  (masked)" : "") << "  " << type.interface_name << "\n";
    for (const std::string& super_type : type.super_types) out << "  : " << super_type << "\n";
    for (const PropertyDefinition& definition : type.properties) {
      out << "  " << (IsMandatory(definition.mode) ? "mandatory " : "")
          << (IsReadonly(definition.mode) ? "readonly " : "") << definition.type.Spelling() << " "
          << definition.name << "\n";
    }
  }
}

void PrintOffersJson(const std::vector<OfferDescription>& offers, std::ostream& out) {
  for (const OfferDescription& offer : offers) {
    OrderedJson properties = OrderedJson::object();
    for (const auto& [name, value] : offer.properties) properties[name] = ToJson(value);
    out << Line({{"id", offer.id},
                 {"type", offer.type},
                 {"address", offer.address},
                 {"interface", offer.interface_id},
                 {"properties", std::move(properties)}});
  }
}

void PrintServiceTypesJson(const std::vector<ServiceType>& types, std::ostream& out) {
  for (const ServiceType& type : types) {
    OrderedJson properties = OrderedJson::array();
    for (const PropertyDefinition& definition : type.properties) {
      properties.push_back(ToJson(definition));
    }
    out << Line({{"name", type.name},
                 {"interface", type.interface_name},
                 {"super_types", type.super_types},
                 {"masked", type.masked},
                 {"incarnation", type.incarnation},
                 {"properties", std::move(properties)}});
  }
}

}  // namespace gsv::broker
