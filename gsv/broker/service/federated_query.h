// A query's way to other traders: through links, and through proxy offers that match it.
#pragma once

#include <string>

#include <COS/CosTrading.hh>

#include "gsv/broker/service/trading_objects.h"

namespace gsv::broker {

struct FederatedQuery {
  Query query;
  const CosTrading::PolicySeq& policies;  // as the importer gave them
  const DesiredProperties& desired;
  std::string request_id;
};

// Adds to what was found here what other traders find, and the names of the policies that limited
// them. A trader that does not answer counts as one whose link was not followed, or whose proxy
// was not used: link_follow_rule or use_proxy_offers is among the names.
// Threads  any; waits for other traders.
void AddFederatedAnswers(TradingObjects& objects, const FederatedQuery& query,
                         MatchingOffers& matches, DynamicValues& values);

// The Lookup that the first name of the policy starting_trader leads to, with what the query to it
// may take as its time-out.
// Errors  throws InvalidPolicyValue when there is no such link.
CosTrading::Lookup_ptr StartingTrader(TradingObjects& objects, const ImportPolicies& import,
                                      const CosTrading::PolicySeq& policies);

}  // namespace gsv::broker
