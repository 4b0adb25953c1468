// The errors of the trader: one value for each exception of the standard, with the members of the
// exception.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "gsv/base/result.h"
#include "gsv/broker/language/property.h"
#include "gsv/broker/offers/import_policies.h"
#include "gsv/broker/offers/service_type.h"

namespace gsv::broker {

// One value for each exception of CosTrading and CosTradingRepos. kLimit is for a request that
// exceeds the trader's limits (CORBA::IMP_LIMIT), and kNotStored for a failure of the disk
// (CORBA::PERSIST_STORE).
enum class Refusal {
  // Members: type
  kIllegalServiceType,
  kUnknownServiceType,
  kServiceTypeExists,
  kDuplicateServiceTypeName,
  kAlreadyMasked,
  kNotMasked,
  // Members: type (the type), name (its sub type)
  kHasSubTypes,
  // Members: name
  kIllegalPropertyName,
  kDuplicatePropertyName,
  kUnknownPropertyName,
  kIllegalOfferId,
  kUnknownOfferId,
  kProxyOfferId,
  kNotProxyOfferId,
  // Members: type, name
  kMissingMandatoryProperty,
  kMandatoryProperty,
  kReadonlyProperty,
  kReadonlyDynamicProperty,
  // Members: type, property
  kPropertyTypeMismatch,
  // Members: name (the refused text)
  kIllegalConstraint,
  kIllegalPreference,
  kIllegalRecipe,
  kNoMatchingOffers,
  kIllegalLinkName,
  kUnknownLinkName,
  kDuplicateLinkName,
  // Members: follow
  kDefaultFollowTooPermissive,
  kLimitingFollowTooPermissive,
  // Members: redefinition
  kValueTypeRedefinition,
  // Members: interfaces
  kInterfaceTypeMismatch,
  // No members.
  kNotImplemented,
  kLimit,
  kNotStored,
};

// A property that two service types define differently.
struct Redefinition {
  std::string type_1;
  PropertyDefinition definition_1;
  std::string type_2;
  PropertyDefinition definition_2;
};

// A service type whose interface does not derive from the interface of its super type.
struct InterfaceMismatch {
  std::string base_service;
  std::string base_interface;
  std::string derived_service;
  std::string derived_interface;
};

// A follow rule that is more permissive than its bound.
struct FollowConflict {
  FollowOption rule;   // the rule that was refused
  FollowOption bound;  // the most permissive rule that is allowed
};

// An error of the trader. `refusal` determines which other members are set.
struct TradingError {
  Refusal refusal = Refusal::kLimit;
  std::string type{};
  std::string name{};
  std::string detail{};  // for users: the reason and the position
  std::optional<Property> property{};
  std::optional<Redefinition> redefinition{};
  std::optional<InterfaceMismatch> interfaces{};
  std::optional<FollowConflict> follow{};
};

template <typename T>
using TradingResult = base::ResultOf<T, TradingError>;

inline base::Failure<TradingError> Refuse(TradingError error) { return {std::move(error)}; }

}  // namespace gsv::broker
