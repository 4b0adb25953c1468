// Forwards a query to other traders, both over links and through proxy offers that match it.
#pragma once

#include <string>

#include <COS/CosTrading.hh>

#include "gsv/broker/service/trading_objects.h"

namespace gsv::broker {

struct FederatedQuery {
  Query query;
  const CosTrading::PolicySeq& policies;  // the importer's policies, unchanged
  const DesiredProperties& desired;       // the properties that the importer requests
  std::string request_id;                 // the same id at every trader that the query reaches
};

// Adds the offers of other traders to the local ones, and the names of the policies that limited
// the result. If a trader does not answer, its link counts as not followed, or its proxy as not
// used. In this case, link_follow_rule or use_proxy_offers is among these names.
// Threads  any; the function waits for other traders.
void AddFederatedAnswers(TradingObjects& objects, const FederatedQuery& query,
                         MatchingOffers& matches, DynamicValues& values);

// Returns the Lookup behind the first link of the policy starting_trader. Its calls have the time
// limit of the query.
// Errors  throws InvalidPolicyValue if there is no such link.
CosTrading::Lookup_ptr StartingTrader(TradingObjects& objects, const ImportPolicies& import,
                                      const CosTrading::PolicySeq& policies);

}  // namespace gsv::broker
