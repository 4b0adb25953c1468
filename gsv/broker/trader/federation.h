// Which links a query follows, and what it asks of the traders behind them.
//
// Source  OMG Trading Object Service (formal/00-06-27), "link follow behavior", "hop_count".
#pragma once

#include <cstdint>
#include <vector>

#include "gsv/broker/offers/import_policies.h"
#include "gsv/broker/trader/link_table.h"

namespace gsv::broker {

// How many hops the query may still make.
std::uint32_t EffectiveHopCount(const ImportPolicies& policies, const TraderAttributes& attributes);

// The query may follow `link`: the least permissive of the importer's rule (or the trader's
// default), the link's, and the trader's.
FollowOption FollowRule(const TraderLink& link, const ImportPolicies& policies,
                        const TraderAttributes& attributes);

// The policy link_follow_rule of the query that goes over `link`.
FollowOption PassOnRule(const TraderLink& link, const ImportPolicies& policies,
                        const TraderAttributes& attributes);

// Those of `links` that the rules have a query follow that found something here, or nothing. The
// hop count is not looked at.
std::vector<TraderLink> LinksToFollow(std::vector<TraderLink> links, const ImportPolicies& policies,
                                      const TraderAttributes& attributes, bool found_local);

}  // namespace gsv::broker
