#include "gsv/broker/trader/type_repository.h"

#include <algorithm>
#include <set>
#include <string>

#include "gsv/base/sorting.h"
#include "gsv/broker/language/names.h"

namespace gsv::broker {
namespace {

constexpr std::string_view kAnyInterface = "IDL:omg.org/CORBA/Object:1.0";

bool IsAnyInterface(std::string_view name) { return name.empty() || name == kAnyInterface; }

const PropertyDefinition* FindDefinition(const std::vector<PropertyDefinition>& definitions,
                                         std::string_view name) {
  const auto found =
      std::find_if(definitions.begin(), definitions.end(),
                   [&](const PropertyDefinition& definition) { return definition.name == name; });
  return found != definitions.end() ? &*found : nullptr;
}

// Returns the first name that an earlier entry of `range` has, too, or null if all names differ.
// `name` returns the name of an entry.
template <typename Range, typename Name>
const std::string* FirstDuplicate(const Range& range, Name name) {
  std::set<std::string_view> seen;
  for (const auto& entry : range) {
    if (!seen.insert(name(entry)).second) return &name(entry);
  }
  return nullptr;
}

std::size_t DescriptionSize(const ServiceType& type) {
  std::size_t size = type.interface_name.size() + 64;
  for (const std::string& name : type.super_types) size += name.size() + 8;
  for (const PropertyDefinition& definition : type.properties) {
    size += definition.name.size() + definition.type.encoded.size() + 40;
  }
  return size;
}

// The definition of a property may only strengthen the inherited definition.
bool Refines(const PropertyDefinition& derived, const PropertyDefinition& base) {
  return derived.type == base.type && Stronger(derived.mode, base.mode) == derived.mode;
}

TradingError RedefinitionError(const std::string& type_1, const PropertyDefinition& definition_1,
                               const std::string& type_2, const PropertyDefinition& definition_2) {
  return {.refusal = Refusal::kValueTypeRedefinition,
          .detail = "the property " + definition_1.name + " is " + definition_1.type.Spelling() +
                    " in " + type_1 + " and " + definition_2.type.Spelling() + " in " + type_2 +
                    ", or its mode is weaker than the inherited one",
          .redefinition = Redefinition{type_1, definition_1, type_2, definition_2}};
}

}  // namespace

base::Status TypeRepository::Restore(std::vector<ServiceType> types,
                                     std::uint64_t next_incarnation) {
  base::Sort(types, [](const ServiceType& a, const ServiceType& b) {
    return a.incarnation < b.incarnation;
  });
  for (ServiceType& type : types) {
    for (const std::string& name : type.super_types) {
      if (types_.contains(name)) continue;
      return base::Fail(
          base::ErrorCode::kCorrupt,
          "the super type " + name + " of the service type " + type.name + " is missing");
    }
    next_incarnation = std::max(next_incarnation, type.incarnation + 1);
    types_.emplace(type.name, std::move(type));
  }
  next_incarnation_ = std::max(next_incarnation_, next_incarnation);
  return {};
}

TradingResult<std::uint64_t> TypeRepository::Add(ServiceType type) {
  if (auto checked = CheckNew(type); !checked) return Refuse(checked.error());
  type.masked = false;
  type.incarnation = next_incarnation_++;
  const std::uint64_t incarnation = type.incarnation;
  types_.emplace(type.name, std::move(type));
  return incarnation;
}

TradingResult<void> TypeRepository::CheckNew(const ServiceType& type) const {
  if (!IsServiceTypeName(type.name)) {
    return Refuse({.refusal = Refusal::kIllegalServiceType, .type = type.name});
  }
  if (types_.contains(type.name)) {
    return Refuse({.refusal = Refusal::kServiceTypeExists, .type = type.name});
  }
  for (const PropertyDefinition& definition : type.properties) {
    if (!IsIdentifier(definition.name) || IsReservedWord(definition.name)) {
      return Refuse({.refusal = Refusal::kIllegalPropertyName, .name = definition.name});
    }
  }
  const auto property_name = [](const PropertyDefinition& d) -> const std::string& {
    return d.name;
  };
  if (const std::string* name = FirstDuplicate(type.properties, property_name)) {
    return Refuse({.refusal = Refusal::kDuplicatePropertyName, .name = *name});
  }
  if (auto checked = CheckSuperTypes(type); !checked) return checked;
  if (auto checked = CheckInheritedProperties(type); !checked) return checked;

  std::size_t names_bytes = type.name.size();
  for (const auto& [name, known] : types_) names_bytes += name.size() + 8;
  if (names_bytes > limits_.type_names_bytes) {
    return Refuse({.refusal = Refusal::kLimit,
                   .detail = "the names of all service types would have more than " +
                             std::to_string(limits_.type_names_bytes) + " bytes"});
  }
  return {};
}

TradingResult<void> TypeRepository::CheckSuperTypes(const ServiceType& type) const {
  for (const std::string& name : type.super_types) {
    const auto super_type = Find(name);
    if (!super_type) return Refuse(super_type.error());
    // Without an interface repository, only one thing can be checked: an empty interface name (any
    // interface) does not derive from a specific interface.
    const std::string& base_interface = (*super_type)->interface_name;
    if (IsAnyInterface(type.interface_name) && !IsAnyInterface(base_interface)) {
      return Refuse(
          {.refusal = Refusal::kInterfaceTypeMismatch,
           .interfaces = InterfaceMismatch{name, base_interface, type.name, type.interface_name}});
    }
  }
  const auto itself = [](const std::string& name) -> const std::string& { return name; };
  if (const std::string* name = FirstDuplicate(type.super_types, itself)) {
    return Refuse({.refusal = Refusal::kDuplicateServiceTypeName, .type = *name});
  }
  return {};
}

TradingResult<void> TypeRepository::CheckInheritedProperties(const ServiceType& type) const {
  struct Inherited {
    const PropertyDefinition* definition;
    const ServiceType* from;
  };
  const std::vector<const ServiceType*> ancestors = Ancestors(type);
  std::map<std::string_view, Inherited> inherited;
  std::size_t size = DescriptionSize(type);
  for (const ServiceType* ancestor : ancestors) {
    size += DescriptionSize(*ancestor);
    for (const PropertyDefinition& definition : ancestor->properties) {
      const auto* own = FindDefinition(type.properties, definition.name);
      if (own != nullptr && !Refines(*own, definition)) {
        return Refuse(RedefinitionError(type.name, *own, ancestor->name, definition));
      }
      const auto [first, added] =
          inherited.emplace(definition.name, Inherited{&definition, ancestor});
      if (!added && !(first->second.definition->type == definition.type)) {
        return Refuse(RedefinitionError(first->second.from->name, *first->second.definition,
                                        ancestor->name, definition));
      }
    }
  }
  if (ancestors.size() > limits_.super_types) {
    return Refuse({.refusal = Refusal::kLimit,
                   .detail = "the service type " + type.name + " has more than " +
                             std::to_string(limits_.super_types) + " super types"});
  }
  if (size > limits_.type_bytes) {
    return Refuse({.refusal = Refusal::kLimit,
                   .detail = "the description of the service type " + type.name +
                             " has more than " + std::to_string(limits_.type_bytes) + " bytes"});
  }
  return {};
}

TradingResult<void> TypeRepository::Remove(const std::string& name) {
  if (const auto found = Find(name); !found) return Refuse(found.error());
  for (const auto& [other, type] : types_) {
    if (std::find(type.super_types.begin(), type.super_types.end(), name) !=
        type.super_types.end()) {
      return Refuse({.refusal = Refusal::kHasSubTypes, .type = name, .name = other});
    }
  }
  types_.erase(name);
  return {};
}

std::vector<std::string> TypeRepository::List(std::optional<std::uint64_t> since) const {
  std::vector<std::string> names;
  for (const auto& [name, type] : types_) {
    if (!since || type.incarnation >= *since) names.push_back(name);
  }
  return names;
}

TradingResult<ServiceType> TypeRepository::Describe(const std::string& name) const {
  const auto type = Find(name);
  if (!type) return Refuse(type.error());
  return **type;
}

TradingResult<ServiceType> TypeRepository::FullyDescribe(const std::string& name) const {
  auto described = Describe(name);
  if (!described) return described;
  const std::vector<const ServiceType*> ancestors = Ancestors(*described);
  described->super_types.clear();
  for (const ServiceType* ancestor : ancestors) {
    described->super_types.push_back(ancestor->name);
    for (const PropertyDefinition& definition : ancestor->properties) {
      const auto* known = FindDefinition(described->properties, definition.name);
      if (known == nullptr) {
        described->properties.push_back(definition);
      } else {
        auto& mode =
            described->properties[static_cast<std::size_t>(known - described->properties.data())]
                .mode;
        mode = Stronger(mode, definition.mode);
      }
    }
  }
  return described;
}

TradingResult<void> TypeRepository::Mask(const std::string& name) {
  if (const auto found = Find(name); !found) return Refuse(found.error());
  ServiceType& type = types_.at(name);
  if (type.masked) return Refuse({.refusal = Refusal::kAlreadyMasked, .type = name});
  type.masked = true;
  return {};
}

TradingResult<void> TypeRepository::Unmask(const std::string& name) {
  if (const auto found = Find(name); !found) return Refuse(found.error());
  ServiceType& type = types_.at(name);
  if (!type.masked) return Refuse({.refusal = Refusal::kNotMasked, .type = name});
  type.masked = false;
  return {};
}

TradingResult<std::vector<std::string>> TypeRepository::WithSubTypes(
    const std::string& name) const {
  if (const auto found = Find(name); !found) return Refuse(found.error());
  std::vector<std::string> names;
  for (const auto& [other, type] : types_) {
    if (other == name || DerivesFrom(type, name)) names.push_back(other);
  }
  return names;
}

TradingResult<const ServiceType*> TypeRepository::Find(const std::string& name) const {
  if (!IsServiceTypeName(name)) {
    return Refuse({.refusal = Refusal::kIllegalServiceType, .type = name});
  }
  const auto found = types_.find(name);
  if (found == types_.end()) {
    return Refuse({.refusal = Refusal::kUnknownServiceType, .type = name});
  }
  return &found->second;
}

std::vector<const ServiceType*> TypeRepository::Ancestors(const ServiceType& type) const {
  std::vector<const ServiceType*> ancestors;
  std::set<std::string_view> seen;
  const auto add_parents = [&](const ServiceType& child) {
    for (const std::string& name : child.super_types) {
      // A type is added only after its super types, and removed before them, so types_ has `name`.
      if (seen.insert(name).second) ancestors.push_back(&types_.at(name));
    }
  };
  add_parents(type);
  for (std::size_t i = 0; i < ancestors.size(); ++i) add_parents(*ancestors[i]);
  return ancestors;
}

bool TypeRepository::DerivesFrom(const ServiceType& type, const std::string& ancestor) const {
  const std::vector<const ServiceType*> ancestors = Ancestors(type);
  return std::any_of(ancestors.begin(), ancestors.end(),
                     [&](const ServiceType* candidate) { return candidate->name == ancestor; });
}

}  // namespace gsv::broker
