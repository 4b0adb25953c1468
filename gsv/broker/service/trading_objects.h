// The objects that the servants of the Trading Service share: the trader, the open iterators, and
// the references of the servants.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <COS/CosTrading.hh>
#include <COS/CosTradingRepos.hh>

#include "gsv/broker/service/dynamic_property_evaluator.h"
#include "gsv/broker/service/query_forwarder.h"
#include "gsv/broker/trader/cursor_table.h"
#include "gsv/broker/trader/request_history.h"
#include "gsv/broker/trader/trader.h"

namespace gsv::broker {

// Maximum number of bytes of offers or names in a reply, so that the reply fits into a GIOP message
// of 64 KiB.
constexpr std::size_t kReplyBytes = 48 * 1024;

// The offers of a query after the first reply. The first use of operator[]
// sorts them. Copies share the offers.
//
// Threads  any.
class RemainingOffers {
 public:
  // Omits the first `replied` offers.
  RemainingOffers(RankedOffers offers, std::size_t replied);

  std::size_t size() const { return size_; }
  const OfferPtr* operator[](std::size_t index) const { return Sorted().places()[first_ + index]; }
  // Returns all offers of the query, sorted. The first call sorts them.
  const FoundOffers& Sorted() const;

 private:
  // The offers as they were found, and after sorting. All copies of an object share one Shared.
  struct Shared {
    std::once_flag once{};  // set when `sorted` is made from `offers`
    RankedOffers offers{};  // the found offers; empty after sorting
    FoundOffers sorted{};   // all offers of the query, sorted
  };

  std::size_t first_;               // index of the first remaining offer in the sorted list
  std::size_t size_;                // number of remaining offers
  std::shared_ptr<Shared> shared_;  // the offers; shared with the copies of this object
};

// The cursors of iterators over offers. The context is the properties that the importer requests.
using OfferCursors = CursorTable<RemainingOffers, DesiredProperties>;
// The context of cursors over ids, which need none.
struct NoContext {};
using OfferIdCursors = CursorTable<std::vector<std::string>, NoContext>;

struct TradingObjects {
  // `stem` and `seed` are arguments of the constructor of Trader. `seed` also makes the ids of
  // requests unique.
  explicit TradingObjects(const TraderLimits& limits, std::uint32_t stem, std::uint64_t seed);

  Trader trader;
  DynamicPropertyEvaluator dynamic;  // calls the services of dynamic properties
  QueryForwarder forwarder;          // forwards queries to other traders
  RequestHistory requests;           // recently answered requests
  OfferCursors offer_cursors;        // results of open OfferIterators
  OfferIdCursors id_cursors;         // results of open OfferIdIterators

  // Returns an id that no other query of any trader has.
  std::string NewRequestId();

  // Set before the first request is served.
  CORBA::ORB_var orb;
  PortableServer::POA_var offer_iterators;  // the POA of the OfferIterators
  PortableServer::POA_var id_iterators;     // the POA of the OfferIdIterators
  CosTrading::Lookup_var lookup;            // the references of this trader's interfaces
  CosTrading::Register_var registry;
  CosTrading::Link_var link;
  CosTrading::Proxy_var proxy;
  CosTrading::Admin_var admin;
  CosTradingRepos::ServiceTypeRepository_var types;

 private:
  const std::string process_;                    // unique to each start of the trader
  std::atomic<std::uint64_t> next_request_ = 0;  // the next request's number, a part of its id
};

}  // namespace gsv::broker
