// A query's way through the links of this trader.
#pragma once

#include <string>

#include <COS/CosTrading.hh>

#include "gsv/broker/trading_objects.h"

namespace gsv::broker {

struct FederatedQuery {
  Query query;
  const CosTrading::PolicySeq& policies;  // as the importer gave them
  const DesiredProperties& desired;
  std::string request_id;
};

// Adds to what was found here what the traders behind the links find, and the names of the
// policies that limited them. A trader that does not answer counts as one whose link was not
// followed: link_follow_rule is among the names.
// Threads  any; waits for other traders.
void AddAnswersOfLinks(TradingObjects& objects, const FederatedQuery& query,
                       MatchingOffers& matches);

// The Lookup that the first name of the policy starting_trader leads to, with what the query to it
// may take as its time-out.
// Errors  throws InvalidPolicyValue when there is no such link.
CosTrading::Lookup_ptr StartingTrader(TradingObjects& objects, const ImportPolicies& import,
                                      const CosTrading::PolicySeq& policies);

}  // namespace gsv::broker
