// The state of a trader that survives a restart, the changes to it, and the interface through which
// the trader stores each change (Journal).
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "gsv/broker/language/offer.h"
#include "gsv/broker/offers/import_policies.h"
#include "gsv/broker/offers/service_type.h"
#include "gsv/broker/trader/link_table.h"

namespace gsv::broker {

// An offer that is new, or replaces the offer that has the same number.
struct OfferStored {
  OfferPtr offer;
};
// The removal of the offers with these numbers.
struct OffersRemoved {
  std::vector<std::uint64_t> numbers;
};
// A service type that is new, or replaces the type that has the same name.
struct TypeStored {
  ServiceType type;
};
// The removal of the service type with this name.
struct TypeRemoved {
  std::string name;
};
// A link that is new, or replaces the link that has the same name.
struct LinkStored {
  TraderLink link;
};
// The removal of the link with this name.
struct LinkRemoved {
  std::string name;
};
// New values of all attributes of the trader.
struct AttributesStored {
  TraderAttributes attributes;
};
using StateChange = std::variant<OfferStored, OffersRemoved, TypeStored, TypeRemoved, LinkStored,
                                 LinkRemoved, AttributesStored>;

// The whole state of a trader.
struct TraderState {
  std::uint32_t stem = 0;              // part of the ids of its offers
  std::uint64_t next_number = 1;       // larger than the number of every offer so far
  std::uint64_t next_incarnation = 1;  // larger than the incarnation of every type so far
  std::vector<ServiceType> types{};
  std::vector<Offer> offers{};
  std::vector<TraderLink> links{};
  TraderAttributes attributes{};
};

// Stores changes in the order of the calls to Append().
// Threads  any.
class Journal {
 public:
  using ChangeNumber = std::uint64_t;  // the number of a change; increases by one

  virtual ~Journal() = default;
  // Returns false after a change could not be stored, and after Close().
  virtual bool works() const = 0;
  // Queues the change without waiting. A caller must wait for the change before appending another
  // change. So there are at most as many queued changes as callers.
  virtual ChangeNumber Append(StateChange change) = 0;
  // Blocks until this change and all changes before it are stored. Returns false if they cannot be
  // stored.
  [[nodiscard]] virtual bool Wait(ChangeNumber number) = 0;
  // Stores all queued changes. Later changes are not stored, and works() returns false.
  virtual void Close() = 0;
};

}  // namespace gsv::broker
