// What the servants of the Trading Service share: the trader, the open iterators, and each
// other's references.
#pragma once

#include <string>
#include <vector>

#include <COS/CosTrading.hh>
#include <COS/CosTradingRepos.hh>

#include "gsv/broker/cursor_table.h"
#include "gsv/broker/dynamic_property_evaluator.h"
#include "gsv/broker/trader.h"

namespace gsv::broker {

// A reply fits a GIOP message of 64 KiB with this many bytes of offers or names.
constexpr std::size_t kReplyBytes = 48 * 1024;

// Which properties of an offer an importer wants to see.
struct DesiredProperties {
  bool all = false;
  std::vector<std::string> names;
};

using OfferCursors = CursorTable<OfferPtr, DesiredProperties>;
struct NoContext {};
using OfferIdCursors = CursorTable<std::string, NoContext>;

struct TradingObjects {
  explicit TradingObjects(const TraderLimits& limits, std::uint32_t stem, std::uint64_t seed);

  Trader trader;
  DynamicPropertyEvaluator dynamic;
  OfferCursors offer_cursors;
  OfferIdCursors id_cursors;

  // Set before the first request is served.
  CORBA::ORB_var orb;
  PortableServer::POA_var offer_iterators;
  PortableServer::POA_var id_iterators;
  CosTrading::Lookup_var lookup;
  CosTrading::Register_var registry;
  CosTrading::Admin_var admin;
  CosTradingRepos::ServiceTypeRepository_var types;
};

}  // namespace gsv::broker
