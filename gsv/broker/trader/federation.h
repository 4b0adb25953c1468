// Determines the links that a query follows, and the policies of the queries that are forwarded
// over them.
//
// Source  OMG Trading Object Service (formal/00-06-27), "link follow behavior", "hop_count".
#pragma once

#include <cstdint>
#include <vector>

#include "gsv/broker/offers/import_policies.h"
#include "gsv/broker/trader/link_table.h"

namespace gsv::broker {

// Returns the number of hops that the query may still make.
std::uint32_t EffectiveHopCount(const ImportPolicies& policies, const TraderAttributes& attributes);

// Returns the rule for following `link`. It is the least permissive of three rules: the importer's
// (or the trader's default), the link's, and the trader's.
FollowOption FollowRule(const TraderLink& link, const ImportPolicies& policies,
                        const TraderAttributes& attributes);

// Returns the policy link_follow_rule of the query that is forwarded over `link`.
FollowOption PassOnRule(const TraderLink& link, const ImportPolicies& policies,
                        const TraderAttributes& attributes);

// Returns the links that the query must follow according to the rules. `found_local` is true if
// this trader has found offers. The hop count is not considered.
std::vector<TraderLink> LinksToFollow(std::vector<TraderLink> links, const ImportPolicies& policies,
                                      const TraderAttributes& attributes, bool found_local);

}  // namespace gsv::broker
