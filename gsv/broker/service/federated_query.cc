#include "gsv/broker/service/federated_query.h"

#include <algorithm>
#include <string_view>

#include "gsv/broker/encoding/record_encoding.h"
#include "gsv/broker/language/names.h"
#include "gsv/broker/offers/recipe.h"
#include "gsv/broker/service/policy_values.h"
#include "gsv/broker/trader/federation.h"

namespace gsv::broker {
namespace {

// Returns the properties that the importer requests and those that the preference needs.
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

// Adds each name once.
void AddLimit(std::string_view name, MatchingOffers& matches) {
  auto& limits = matches.limits_applied;
  if (!IsIdentifier(name) || std::find(limits.begin(), limits.end(), name) != limits.end()) return;
  limits.emplace_back(name);
}

struct Destinations {
  std::vector<QueryDestination> all{};
  // for each element of `all`, the policy to report if that trader does not answer
  std::vector<std::string_view> policies{};

  void Add(QueryDestination destination, std::string_view policy) {
    all.push_back(std::move(destination));
    policies.push_back(policy);
  }
};

void AddLinks(TradingObjects& objects, const FederatedQuery& query,
              const TraderAttributes& attributes, std::uint32_t hops, MatchingOffers& matches,
              Destinations& destinations) {
  const ImportPolicies& import = query.query.policies;
  const bool found_local = !matches.offers.empty() || !matches.proxies.empty();
  const auto links = LinksToFollow(objects.trader.links(), import, attributes, found_local);
  if (hops == 0 && !links.empty()) return AddLimit("hop_count", matches);
  for (const TraderLink& link : links) {
    const PassedPolicies passed{.hop_count = hops - 1,
                                .link_follow_rule = PassOnRule(link, import, attributes),
                                .request_id = query.request_id};
    destinations.Add({.name = "link " + link.name,
                      .target = link.target,
                      .constraint = query.query.constraint,
                      .policies = PoliciesToPassOn(query.policies, passed)},
                     "link_follow_rule");
  }
}

// Adds a destination for each proxy offer. A proxy's target is called even if no hops remain; then
// its hop_count is 0, too. Otherwise the target gets one hop less, so that it waits a shorter time
// for other traders than this trader waits for the target.
void AddProxies(TradingObjects& objects, const FederatedQuery& query, std::uint32_t hops,
                MatchingOffers& matches, DynamicValues& values, Destinations& destinations) {
  const std::size_t most = objects.trader.limits().federation.proxies;
  for (const OfferPtr& proxy : matches.proxies) {
    const auto constraint =
        FollowRecipe(proxy->proxy->recipe, EvaluatedOffer(*proxy, values), query.query.constraint);
    const auto policies = DecodePolicies(proxy->proxy->policies);
    if (!constraint || !policies) continue;
    if (destinations.all.size() == most) return AddLimit("use_proxy_offers", matches);
    const PassedPolicies passed{
        .hop_count = hops == 0 ? 0 : hops - 1, .request_id = query.request_id, .fixed = *policies};
    destinations.Add({.name = "proxy " + objects.trader.IdOf(*proxy),
                      .target = proxy->reference,
                      .constraint = *constraint,
                      .policies = PoliciesToPassOn(query.policies, passed)},
                     "use_proxy_offers");
  }
}

}  // namespace

void AddFederatedAnswers(TradingObjects& objects, const FederatedQuery& query,
                         MatchingOffers& matches, DynamicValues& values) {
  const TraderAttributes attributes = objects.trader.attributes();
  const std::uint32_t hops = EffectiveHopCount(query.query.policies, attributes);
  Destinations destinations;
  AddProxies(objects, query, hops, matches, values, destinations);
  AddLinks(objects, query, attributes, hops, matches, destinations);
  if (destinations.all.empty()) return;

  const ForwardedQuery forwarded{
      .type = query.query.type,
      .preference = query.query.preference,
      .desired = WithThoseOf(matches.preference, query.desired),
      .at_most = matches.cardinalities.returned,
      .deadline = std::chrono::steady_clock::now() +
                  std::max(hops, 1u) * objects.trader.limits().federation.per_hop};
  auto answers = objects.forwarder.Ask(objects.orb, forwarded, destinations.all);
  for (std::size_t i = 0; i < answers.size(); ++i) {
    for (OfferPtr& offer : answers[i].offers) matches.offers.AddOther(std::move(offer));
    for (const std::string& name : answers[i].limits_applied) AddLimit(name, matches);
    if (!answers[i].complete) AddLimit(destinations.policies[i], matches);
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
  // The number of steps: one for the called trader, one for each name, and one for each hop that
  // the query may still make.
  const auto steps =
      1 + import.starting_trader.size() + EffectiveHopCount(import, objects.trader.attributes());
  omniORB::setClientCallTimeout(lookup,
                                static_cast<unsigned long>((steps * limits.per_hop).count()));
  return lookup._retn();
}

}  // namespace gsv::broker
