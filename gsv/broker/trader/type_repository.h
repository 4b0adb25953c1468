// The known service types and their inheritance.
//
// Source   OMG Trading Object Service (formal/00-06-27), "ServiceTypeRepository".
// Errors   the errors of the standard, see Refusal.
// Threads  not safe; Trader serialises access.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/broker/language/limits.h"
#include "gsv/broker/offers/service_type.h"
#include "gsv/broker/offers/trading_error.h"

namespace gsv::broker {

class TypeRepository {
 public:
  explicit TypeRepository(const TraderLimits& limits) : limits_(limits) {}

  // The incarnation that the next added type gets.
  std::uint64_t next_incarnation() const { return next_incarnation_; }

  // Restores the types of an earlier repository, in any order.
  // Errors  kCorrupt if a super type is missing, or newer than its sub type.
  [[nodiscard]] base::Status Restore(std::vector<ServiceType> types,
                                     std::uint64_t next_incarnation);

  // Adds a type with the name, interface, properties and super types of `type`. Ignores the other
  // members of `type`. Returns the incarnation of the new type.
  TradingResult<std::uint64_t> Add(ServiceType type);
  TradingResult<void> Remove(const std::string& name);
  // Returns the names of all types, or of the types whose incarnation is at least `since`, sorted.
  std::vector<std::string> List(std::optional<std::uint64_t> since) const;
  // Returns the type as it was added.
  TradingResult<ServiceType> Describe(const std::string& name) const;
  // Returns the type with all inherited properties and all its direct and indirect super types.
  TradingResult<ServiceType> FullyDescribe(const std::string& name) const;
  // Masks a type, so that no more offers of it are exported. Unmask() allows them again.
  TradingResult<void> Mask(const std::string& name);
  TradingResult<void> Unmask(const std::string& name);

  // Returns `name` and every type that derives from it, sorted.
  TradingResult<std::vector<std::string>> WithSubTypes(const std::string& name) const;

 private:
  // Returns the type as it was added. Fails if `name` is not a legal name of a service type, or if
  // no type has this name.
  TradingResult<const ServiceType*> Find(const std::string& name) const;
  // Checks the names in a new type, and that no type has its name.
  TradingResult<void> CheckNew(const ServiceType& type) const;
  // Checks that the super types exist, and that their interfaces fit.
  TradingResult<void> CheckSuperTypes(const ServiceType& type) const;
  // Checks that the type and its super types do not define a property in conflicting ways, and that
  // what the type inherits is within the limits.
  TradingResult<void> CheckInheritedProperties(const ServiceType& type) const;
  // Returns all super types of `type`. The nearest come first, and each occurs once.
  std::vector<const ServiceType*> Ancestors(const ServiceType& type) const;
  // Whether `ancestor` is a direct or indirect super type of `type`.
  bool DerivesFrom(const ServiceType& type, const std::string& ancestor) const;

  TraderLimits limits_;
  std::map<std::string, ServiceType> types_;
  std::uint64_t next_incarnation_ = 1;
};

}  // namespace gsv::broker
