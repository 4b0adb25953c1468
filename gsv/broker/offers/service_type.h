// What an offer of a service type must and may say.
//
// Source  OMG Trading Object Service (formal/00-06-27), "service types".
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "gsv/broker/language/value.h"

namespace gsv::broker {

// As CosTradingRepos::ServiceTypeRepository::PropertyMode: bit 0 says read-only, bit 1 mandatory.
enum class PropertyMode : std::uint8_t {
  kNormal = 0,             // may be absent, changed, and removed
  kReadonly = 1,           // may be absent; once given it is not changed
  kMandatory = 2,          // is always there
  kMandatoryReadonly = 3,  // is always there and is not changed
};

inline bool IsReadonly(PropertyMode mode) { return (static_cast<int>(mode) & 1) != 0; }
inline bool IsMandatory(PropertyMode mode) { return (static_cast<int>(mode) & 2) != 0; }
// As demanding as both together.
inline PropertyMode Stronger(PropertyMode a, PropertyMode b) {
  return static_cast<PropertyMode>(static_cast<int>(a) | static_cast<int>(b));
}

struct PropertyDefinition {
  std::string name{};
  PropertyType type{};
  PropertyMode mode = PropertyMode::kNormal;
};

struct ServiceType {
  std::string name{};
  // The interface that offered services have: a repository identifier, or a scoped name, or
  // nothing for any interface.
  std::string interface_name{};
  std::vector<PropertyDefinition> properties{};
  std::vector<std::string> super_types{};
  bool masked = false;            // no offers of this very type are taken
  std::uint64_t incarnation = 0;  // grows with each type that is added
};

}  // namespace gsv::broker
