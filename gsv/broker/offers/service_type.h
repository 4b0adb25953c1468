// A service type: the interface of its offers, and the properties that offers must or may have.
//
// Source  OMG Trading Object Service (formal/00-06-27), "service types".
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "gsv/broker/language/value.h"

namespace gsv::broker {

// As CosTradingRepos::ServiceTypeRepository::PropertyMode: bit 0 is read-only, bit 1 is mandatory.
enum class PropertyMode : std::uint8_t {
  kNormal = 0,             // the property may be absent, changed, and removed
  kReadonly = 1,           // the property may be absent, and cannot be changed after the export
  kMandatory = 2,          // the property is always present
  kMandatoryReadonly = 3,  // the property is always present and cannot be changed
};

inline bool IsReadonly(PropertyMode mode) { return (static_cast<int>(mode) & 1) != 0; }
inline bool IsMandatory(PropertyMode mode) { return (static_cast<int>(mode) & 2) != 0; }
// Returns the mode with the requirements of both modes.
inline PropertyMode Stronger(PropertyMode a, PropertyMode b) {
  return static_cast<PropertyMode>(static_cast<int>(a) | static_cast<int>(b));
}

// A property that a service type declares.
struct PropertyDefinition {
  std::string name{};
  PropertyType type{};
  PropertyMode mode = PropertyMode::kNormal;
};

struct ServiceType {
  std::string name{};
  // The interface of the offered services, as a repository identifier or a scoped name. Empty for
  // any interface.
  std::string interface_name{};
  // The properties that this type itself declares. In a fully described type, also the inherited
  // ones.
  std::vector<PropertyDefinition> properties{};
  std::vector<std::string> super_types{};
  bool masked = false;            // whether offers of exactly this type are refused
  std::uint64_t incarnation = 0;  // increases with each added type
};

}  // namespace gsv::broker
