// The objects that the servants of the Trading Service share: the trader, the open iterators, and
// the references of the servants.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
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

// The properties that the client requests, and the memory of the cursor's offers.
struct OfferCursorContext {
  DesiredProperties desired{};
  std::shared_ptr<const KeptOffers> kept{};
};
using OfferCursors = CursorTable<const OfferPtr*, OfferCursorContext>;
struct NoContext {};
using OfferIdCursors = CursorTable<std::string, NoContext>;

struct TradingObjects {
  explicit TradingObjects(const TraderLimits& limits, std::uint32_t stem, std::uint64_t seed);

  Trader trader;
  DynamicPropertyEvaluator dynamic;
  QueryForwarder forwarder;
  RequestHistory requests;
  OfferCursors offer_cursors;
  OfferIdCursors id_cursors;

  // Returns an id that no other query of any trader has.
  std::string NewRequestId();

  // Set before the first request is served.
  CORBA::ORB_var orb;
  PortableServer::POA_var offer_iterators;
  PortableServer::POA_var id_iterators;
  CosTrading::Lookup_var lookup;
  CosTrading::Register_var registry;
  CosTrading::Link_var link;
  CosTrading::Proxy_var proxy;
  CosTrading::Admin_var admin;
  CosTradingRepos::ServiceTypeRepository_var types;

 private:
  const std::string process_;  // unique to each start of the trader
  std::atomic<std::uint64_t> next_request_ = 0;
};

}  // namespace gsv::broker
