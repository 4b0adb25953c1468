#include "gsv/broker/trader/federation.h"

#include <algorithm>

namespace gsv::broker {

std::uint32_t EffectiveHopCount(const ImportPolicies& policies,
                                const TraderAttributes& attributes) {
  return std::min(policies.hop_count.value_or(attributes.def_hop_count), attributes.max_hop_count);
}

FollowOption FollowRule(const TraderLink& link, const ImportPolicies& policies,
                        const TraderAttributes& attributes) {
  return std::min({policies.link_follow_rule.value_or(attributes.def_follow_policy), link.limiting,
                   attributes.max_follow_policy});
}

FollowOption PassOnRule(const TraderLink& link, const ImportPolicies& policies,
                        const TraderAttributes& attributes) {
  if (!policies.link_follow_rule) return std::min(link.def_pass_on, attributes.max_follow_policy);
  return std::min({*policies.link_follow_rule, link.limiting, attributes.max_follow_policy});
}

std::vector<TraderLink> LinksToFollow(std::vector<TraderLink> links, const ImportPolicies& policies,
                                      const TraderAttributes& attributes, bool found_local) {
  const FollowOption least = found_local ? FollowOption::kAlways : FollowOption::kIfNoLocal;
  std::erase_if(links, [&](const TraderLink& link) {
    return FollowRule(link, policies, attributes) < least;
  });
  return links;
}

}  // namespace gsv::broker
