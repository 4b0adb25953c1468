#include <algorithm>
#include <map>
#include <shared_mutex>

#include "gsv/broker/equality_terms.h"
#include "gsv/broker/evaluation.h"
#include "gsv/broker/number_terms.h"
#include "gsv/broker/preference_order.h"
#include "gsv/broker/query_compilation.h"
#include "gsv/broker/trader.h"

namespace gsv::broker {
namespace {

using ReadLock = std::shared_lock<std::shared_mutex>;

// As many steps of an evaluation are over soon.
constexpr std::size_t kWorthATurn = 20'000;

// Fewer offers are looked through as fast as they are found in an index.
constexpr std::size_t kWorthAnIndex = 256;

bool IsReadonlyIn(const ServiceType& type, const Property& property) {
  return std::any_of(type.properties.begin(), type.properties.end(),
                     [&](const PropertyDefinition& definition) {
                       return definition.name == property.name && IsReadonly(definition.mode);
                     });
}

bool HasModifiableProperties(const ServiceType& type, const Offer& offer) {
  const std::vector<Property>& properties = offer.properties.all();
  return !std::all_of(properties.begin(), properties.end(),
                      [&](const Property& property) { return IsReadonlyIn(type, property); });
}

bool IsMatch(const Expression& constraint, const Offer& offer, DynamicValues& values) {
  return (offer.proxy != nullptr && offer.proxy->if_match_all) ||
         Matches(constraint, EvaluatedOffer(offer, values));
}

}  // namespace

// The offers to be searched, without those that the policies leave out.
struct Trader::Candidates {
  std::vector<OfferView> views{};
  Cardinalities cardinalities{};
  std::vector<std::string> limits_applied{};
  bool cut = false;  // there are more of them than may be searched
  bool with_proxies = true;
  bool with_dynamic = true;
  bool with_modifiable = true;
  std::map<std::string, ServiceType> types{};  // described if without modifiable ones

  // What it may take to look through them.
  std::size_t Steps(const Expression& constraint) const;
  void Search(const Expression& constraint, DynamicValues& values, MatchingOffers& matches) const;
  bool Admit(const Offer& offer) const {
    return (with_proxies || offer.proxy == nullptr) &&
           (with_dynamic || !HasDynamicProperties(offer)) &&
           (with_modifiable || !HasModifiableProperties(types.at(offer.type), offer));
  }
};

Traded<QueryResult> Trader::Find(const Query& query) const {
  DynamicValues none(nullptr, {});
  return Find(query, none);
}

Traded<QueryResult> Trader::Find(const Query& query, DynamicValues& values) const {
  auto matches = FindMatching(query, values);
  if (!matches) return Refuse(matches.error());
  return Rank(std::move(*matches), values);
}

Traded<MatchingOffers> Trader::FindMatching(const Query& query, DynamicValues& values) const {
  const auto type = FullyDescribeType(query.type);
  if (!type) return Refuse(type.error());
  const auto constraint = CompileConstraint(query.constraint, *type, limits_.expression);
  if (!constraint) return Refuse(constraint.error());
  auto preference = CompilePreference(query.preference, *type, limits_.expression);
  if (!preference) return Refuse(preference.error());

  Candidates candidates = SelectCandidates(query, EqualityTerms(*constraint));
  MatchingOffers matches{.preference = std::move(*preference),
                         .cardinalities = candidates.cardinalities,
                         .limits_applied = std::move(candidates.limits_applied)};
  ScanTurn turn(candidates.Steps(*constraint) > kWorthATurn ? &scan_turns_ : nullptr);
  values.set_turn(&turn);
  candidates.Search(*constraint, values, matches);
  values.set_turn(nullptr);
  return matches;
}

std::size_t Trader::Candidates::Steps(const Expression& constraint) const {
  std::size_t offers = 0;
  for (const OfferView& view : views) offers += view.offers().size();
  return offers * constraint.nodes.size();
}

void Trader::Candidates::Search(const Expression& constraint, DynamicValues& values,
                                MatchingOffers& matches) const {
  const NumberTerms terms = NumberTermsOf(constraint);
  std::size_t to_search = cardinalities.search;
  for (const OfferView& view : views) {
    // What is cut off depends on every offer before it.
    const std::vector<Choice> choices = cut ? std::vector<Choice>() : view.Choose(terms.terms);
    for (std::size_t i = 0; i < view.offers().size(); ++i) {
      const Choice choice = choices.empty() ? Choice::kUnknown : choices[i];
      if (choice == Choice::kNo) continue;
      const OfferPtr& offer = view.offers()[i];
      if (offer == nullptr) continue;
      if (to_search-- == 0) return;
      const bool known = choice == Choice::kYes && terms.complete;
      if (!Admit(*offer) || !(known || IsMatch(constraint, *offer, values))) continue;
      if (matches.offers.size() + matches.proxies.size() == cardinalities.match) {
        matches.limits_applied.emplace_back("match_card");
        return;
      }
      (offer->proxy != nullptr ? matches.proxies : matches.offers).push_back(offer);
    }
  }
}

QueryResult Trader::Rank(MatchingOffers matches, DynamicValues& values) const {
  OrderBy(matches.preference, seed_++, values, matches.offers);
  if (matches.offers.size() > matches.cardinalities.returned) {
    matches.offers.resize(matches.cardinalities.returned);
    matches.limits_applied.emplace_back("return_card");
  }
  return {std::move(matches.offers), std::move(matches.limits_applied)};
}

Trader::Candidates Trader::SelectCandidates(const Query& query,
                                            const std::vector<EqualityTerm>& terms) const {
  ReadLock lock(mutex_);
  const ImportPolicies& policies = query.policies;
  Candidates candidates{
      .cardinalities = EffectiveCardinalities(policies, attributes_),
      .with_proxies = policies.use_proxy_offers && attributes_.supports_proxy_offers,
      .with_dynamic = policies.use_dynamic_properties && attributes_.supports_dynamic_properties,
      .with_modifiable =
          policies.use_modifiable_properties || !attributes_.supports_modifiable_properties};
  std::vector<std::string> types = {query.type};
  if (!policies.exact_type_match) types = types_.WithSubTypes(query.type).value_or(types);
  if (!candidates.with_modifiable) {
    for (const std::string& name : types) {
      candidates.types.emplace(name,
                               types_.FullyDescribe(name).value_or(ServiceType{.name = name}));
    }
  }
  const std::size_t count = offers_.CountOfTypes(types);
  candidates.cut = count > candidates.cardinalities.search;
  if (candidates.cut) candidates.limits_applied.emplace_back("search_card");
  if (!candidates.cut && !terms.empty() && count >= kWorthAnIndex) {
    if (auto chosen = offers_.OfTypesWith(types, terms)) {
      candidates.views = std::move(*chosen);
      return candidates;
    }
    lock.unlock();
    MakeIndex(types, terms);
    lock.lock();
    if (auto chosen = offers_.OfTypesWith(types, terms)) {
      candidates.views = std::move(*chosen);
      return candidates;
    }
  }
  candidates.views = offers_.OfTypes(types);
  return candidates;
}

void Trader::MakeIndex(const std::vector<std::string>& types,
                       const std::vector<EqualityTerm>& terms) const {
  const std::unique_lock lock(mutex_);
  offers_.Index(types, terms);
}

Traded<std::size_t> Trader::WithdrawMatching(const std::string& type, const std::string& constraint,
                                             DynamicEvaluator* evaluator) {
  const auto described = FullyDescribeType(type);
  if (!described) return Refuse(described.error());
  const auto compiled = CompileConstraint(constraint, *described, limits_.expression);
  if (!compiled) return Refuse(compiled.error());

  // Services are asked for dynamic properties without the lock.
  const std::vector<OfferView> views = [&] {
    const ReadLock lock(mutex_);
    return offers_.OfTypes(types_.WithSubTypes(type).value_or(std::vector<std::string>{}));
  }();
  DynamicValues values(evaluator, limits_.dynamic.query_budget);
  Offers matching;
  for (const OfferView& view : views) {
    for (const OfferPtr& offer : view.offers()) {
      if (offer == nullptr || offer->proxy != nullptr) continue;
      if (IsMatch(*compiled, *offer, values)) matching.push_back(offer);
    }
  }

  return Change([&]() -> Traded<std::size_t> {
    OffersRemoved removed;
    for (const OfferPtr& offer : matching) {
      // One that was modified meanwhile may not match any more.
      if (offers_.Find(offer->number) != offer) continue;
      offers_.Remove(offer->number);
      removed.numbers.push_back(offer->number);
    }
    const std::size_t count = removed.numbers.size();
    if (count == 0) return Refuse({.refusal = Refusal::kNoMatchingOffers, .name = constraint});
    Record(std::move(removed));
    return count;
  });
}

}  // namespace gsv::broker
