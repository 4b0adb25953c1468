#include "gsv/broker/trader/offer_rules.h"

#include <algorithm>
#include <set>
#include <string_view>

#include "gsv/broker/language/names.h"
#include "gsv/broker/offers/dynamic_values.h"

namespace gsv::broker {
namespace {

const PropertyDefinition* FindDefinition(const ServiceType& type, std::string_view name) {
  const auto found =
      std::find_if(type.properties.begin(), type.properties.end(),
                   [&](const PropertyDefinition& definition) { return definition.name == name; });
  return found != type.properties.end() ? &*found : nullptr;
}

TradingResult<void> CheckNames(const std::vector<std::string_view>& names) {
  std::set<std::string_view> seen;
  for (const std::string_view name : names) {
    if (!IsIdentifier(name) || IsReservedWord(name)) {
      return Refuse({.refusal = Refusal::kIllegalPropertyName, .name = std::string(name)});
    }
    if (!seen.insert(name).second) {
      return Refuse({.refusal = Refusal::kDuplicatePropertyName, .name = std::string(name)});
    }
  }
  return {};
}

// A property that the type does not declare may have any value.
TradingResult<void> CheckValue(const ServiceType& type, const Property& property,
                               bool dynamic_allowed) {
  const PropertyDefinition* definition = FindDefinition(type, property.name);
  const bool dynamic = IsDynamic(property.value);
  if (dynamic && definition != nullptr && IsReadonly(definition->mode)) {
    return Refuse(
        {.refusal = Refusal::kReadonlyDynamicProperty, .type = type.name, .name = property.name});
  }
  bool fits = !dynamic || dynamic_allowed;
  if (definition != nullptr) {
    fits = fits && (dynamic ? *property.value.AsOther()->promised_type == definition->type
                            : property.value.Is(definition->type));
  }
  if (fits) return {};
  return Refuse(
      {.refusal = Refusal::kPropertyTypeMismatch, .type = type.name, .property = property});
}

TradingResult<void> CheckRemoval(const ServiceType& type, const PropertyList& current,
                                 const std::string& name) {
  if (current.Find(name) == nullptr) {
    return Refuse({.refusal = Refusal::kUnknownPropertyName, .name = name});
  }
  const PropertyDefinition* definition = FindDefinition(type, name);
  if (definition != nullptr && IsMandatory(definition->mode)) {
    return Refuse({.refusal = Refusal::kMandatoryProperty, .type = type.name, .name = name});
  }
  return {};
}

// A change may add a read-only property that the offer does not have yet.
TradingResult<void> CheckChange(const ServiceType& type, const PropertyList& current,
                                const Property& property, bool dynamic_allowed) {
  const PropertyDefinition* definition = FindDefinition(type, property.name);
  if (definition != nullptr && IsReadonly(definition->mode) &&
      current.Find(property.name) != nullptr) {
    return Refuse(
        {.refusal = Refusal::kReadonlyProperty, .type = type.name, .name = property.name});
  }
  return CheckValue(type, property, dynamic_allowed);
}

}  // namespace

TradingResult<PropertyList> CheckExport(const ServiceType& type, std::vector<Property> properties,
                                        bool dynamic_allowed) {
  std::vector<std::string_view> names;
  names.reserve(properties.size());
  for (const Property& property : properties) names.emplace_back(property.name);
  if (auto checked = CheckNames(names); !checked) return Refuse(checked.error());
  for (const Property& property : properties) {
    if (auto checked = CheckValue(type, property, dynamic_allowed); !checked)
      return Refuse(checked.error());
  }
  PropertyList list(std::move(properties));
  for (const PropertyDefinition& definition : type.properties) {
    if (IsMandatory(definition.mode) && list.Find(definition.name) == nullptr) {
      return Refuse({.refusal = Refusal::kMissingMandatoryProperty,
                     .type = type.name,
                     .name = definition.name});
    }
  }
  return list;
}

TradingResult<PropertyList> CheckModification(const ServiceType& type, PropertyList current,
                                              Modification modification, bool dynamic_allowed) {
  std::vector<std::string_view> names(modification.remove.begin(), modification.remove.end());
  for (const Property& property : modification.set) names.emplace_back(property.name);
  if (auto checked = CheckNames(names); !checked) return Refuse(checked.error());
  for (const std::string& name : modification.remove) {
    if (auto checked = CheckRemoval(type, current, name); !checked) return Refuse(checked.error());
  }
  for (const Property& property : modification.set) {
    if (auto checked = CheckChange(type, current, property, dynamic_allowed); !checked) {
      return Refuse(checked.error());
    }
  }
  for (const std::string& name : modification.remove) current.Remove(name);
  for (Property& property : modification.set) current.Set(std::move(property));
  return current;
}

}  // namespace gsv::broker
