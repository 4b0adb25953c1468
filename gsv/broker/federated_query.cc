#include "gsv/broker/federated_query.h"

#include <algorithm>
#include <string_view>

#include "gsv/broker/federation.h"
#include "gsv/broker/names.h"
#include "gsv/broker/policy_values.h"

namespace gsv::broker {
namespace {

// What the importer wants to see, and what is needed to order it.
DesiredProperties WithThoseOf(const Preference& preference, DesiredProperties desired) {
  if (desired.all) return desired;
  for (const Node& node : preference.expression.nodes) {
    if (node.property.empty()) continue;
    const auto& names = desired.names;
    if (std::find(names.begin(), names.end(), node.property) == names.end()) {
      desired.names.push_back(node.property);
    }
  }
  return desired;
}

// Each name once.
void AddLimit(std::string_view name, MatchingOffers& matches) {
  auto& limits = matches.limits_applied;
  if (!IsIdentifier(name) || std::find(limits.begin(), limits.end(), name) != limits.end()) return;
  limits.emplace_back(name);
}

std::vector<QueryDestination> Destinations(const std::vector<TraderLink>& links,
                                           const FederatedQuery& query,
                                           const TraderAttributes& attributes, std::uint32_t hops) {
  std::vector<QueryDestination> destinations;
  for (const TraderLink& link : links) {
    const PassedPolicies passed{
        .hop_count = hops - 1,
        .link_follow_rule = PassOnRule(link, query.query.policies, attributes),
        .request_id = query.request_id};
    destinations.push_back({.name = "link " + link.name,
                            .target = link.target,
                            .constraint = query.query.constraint,
                            .policies = PoliciesToPassOn(query.policies, passed)});
  }
  return destinations;
}

}  // namespace

void AddAnswersOfLinks(TradingObjects& objects, const FederatedQuery& query,
                       MatchingOffers& matches) {
  const TraderAttributes attributes = objects.trader.attributes();
  const ImportPolicies& import = query.query.policies;
  const std::vector<TraderLink> links =
      LinksToFollow(objects.trader.links(), import, attributes, !matches.offers.empty());
  if (links.empty()) return;
  const std::uint32_t hops = EffectiveHopCount(import, attributes);
  if (hops == 0) return AddLimit("hop_count", matches);

  const ForwardedQuery forwarded{.type = query.query.type,
                                 .preference = query.query.preference,
                                 .desired = WithThoseOf(matches.preference, query.desired),
                                 .at_most = matches.cardinalities.returned,
                                 .deadline = std::chrono::steady_clock::now() +
                                             hops * objects.trader.limits().federation.per_hop};
  for (ForwardedAnswer& answer : objects.forwarder.Ask(
           objects.orb, forwarded, Destinations(links, query, attributes, hops))) {
    std::move(answer.offers.begin(), answer.offers.end(), std::back_inserter(matches.offers));
    for (const std::string& name : answer.limits_applied) AddLimit(name, matches);
    if (!answer.complete) AddLimit("link_follow_rule", matches);
  }
}

CosTrading::Lookup_ptr StartingTrader(TradingObjects& objects, const ImportPolicies& import,
                                      const CosTrading::PolicySeq& policies) {
  const FederationLimits& limits = objects.trader.limits().federation;
  const auto link = objects.trader.DescribeLink(import.starting_trader.front());
  if (!link || import.starting_trader.size() > limits.trader_name) {
    CORBA::ULong at = 0;
    while (std::string_view(policies[at].name.in()) != "starting_trader") ++at;
    throw CosTrading::Lookup::InvalidPolicyValue(policies[at]);
  }
  const CORBA::Object_var object = objects.orb->string_to_object(link->target.c_str());
  CosTrading::Lookup_var lookup = CosTrading::Lookup::_unchecked_narrow(object);
  // One step for the trader that is asked, one for each name, and those that the query may make.
  const auto steps =
      1 + import.starting_trader.size() + EffectiveHopCount(import, objects.trader.attributes());
  omniORB::setClientCallTimeout(lookup,
                                static_cast<unsigned long>((steps * limits.per_hop).count()));
  return lookup._retn();
}

}  // namespace gsv::broker
