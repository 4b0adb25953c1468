// Determines the links that a query follows, and the policies for the traders behind them.
//
// Source  OMG Trading Object Service (formal/00-06-27), "link follow behavior", "hop_count".
#pragma once

#include <cstdint>
#include <vector>

#include "gsv/broker/offers/import_policies.h"
#include "gsv/broker/trader/link_table.h"

namespace gsv::broker {

// The number of hops that the query may still make.
std::uint32_t EffectiveHopCount(const ImportPolicies& policies, const TraderAttributes& attributes);

// The rule for following `link`: the least permissive of the importer's rule (or the trader's
// default), the link's, and the trader's.
FollowOption FollowRule(const TraderLink& link, const ImportPolicies& policies,
                        const TraderAttributes& attributes);

// The policy link_follow_rule of the query that is forwarded over `link`.
FollowOption PassOnRule(const TraderLink& link, const ImportPolicies& policies,
                        const TraderAttributes& attributes);

// The links that the query must follow by the rules; `found_local`: this trader has found offers.
// The hop count is not considered.
std::vector<TraderLink> LinksToFollow(std::vector<TraderLink> links, const ImportPolicies& policies,
                                      const TraderAttributes& attributes, bool found_local);

}  // namespace gsv::broker
