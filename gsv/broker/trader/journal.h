// The durable state of a trader, passed to its storage change by change.
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

// A new offer, or one in the place of that with its number.
struct OfferStored {
  OfferPtr offer;
};
struct OffersRemoved {
  std::vector<std::uint64_t> numbers;
};
// A new service type, or one in the place of that with its name.
struct TypeStored {
  ServiceType type;
};
struct TypeRemoved {
  std::string name;
};
// A new link, or one in the place of that with its name.
struct LinkStored {
  TraderLink link;
};
struct LinkRemoved {
  std::string name;
};
struct AttributesStored {
  TraderAttributes attributes;
};
using StateChange = std::variant<OfferStored, OffersRemoved, TypeStored, TypeRemoved, LinkStored,
                                 LinkRemoved, AttributesStored>;

// All that a trader knows.
struct TraderState {
  std::uint32_t stem = 0;              // of its offers' ids
  std::uint64_t next_number = 1;       // above that of every offer there ever was
  std::uint64_t next_incarnation = 1;  // above that of every type there ever was
  std::vector<ServiceType> types{};
  std::vector<Offer> offers{};
  std::vector<TraderLink> links{};
  TraderAttributes attributes{};
};

// Threads  any; the order is that of the calls to Append.
class Journal {
 public:
  using Ticket = std::uint64_t;  // grows with each change

  virtual ~Journal() = default;
  // False from the first change that could not be written on.
  virtual bool works() const = 0;
  // Takes the change without waiting. A caller waits for it before it appends another, so that
  // no more changes are underway than there are callers.
  virtual Ticket Append(StateChange change) = 0;
  // Returns when this change and all before it are kept; false when they never will be.
  [[nodiscard]] virtual bool Wait(Ticket ticket) = 0;
  // Keeps what was appended, and nothing from then on: it no longer works.
  virtual void Close() = 0;
};

}  // namespace gsv::broker
