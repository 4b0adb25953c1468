#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <optional>

#include "gsv/base/mutex.h"
#include "gsv/broker/language/equality_terms.h"
#include "gsv/broker/language/evaluation.h"
#include "gsv/broker/offers/column_constraint.h"
#include "gsv/broker/offers/preference_order.h"
#include "gsv/broker/offers/query_compilation.h"
#include "gsv/broker/trader/trader.h"

namespace gsv::broker {
namespace {

// One step is the evaluation of one node of the constraint for one offer. A search of at most this
// many steps is short and needs no slot (scan_slots.h).
constexpr std::size_t kMinStepsForSlot = 20'000;

// With fewer offers, a scan is as fast as an index.
constexpr std::size_t kWorthAnIndex = 256;

bool IsReadonlyIn(const ServiceType& type, const std::string& name) {
  return std::any_of(type.properties.begin(), type.properties.end(),
                     [&](const PropertyDefinition& definition) {
                       return definition.name == name && IsReadonly(definition.mode);
                     });
}

bool HasModifiableProperties(const ServiceType& type, const Offer& offer) {
  const PropertyNames& names = *offer.properties.names();
  return !std::all_of(names.begin(), names.end(),
                      [&](const std::string& name) { return IsReadonlyIn(type, name); });
}

// Returns the integer as a double, or nullopt if a double cannot hold it exactly.
std::optional<double> ExactNumber(std::int64_t integer) {
  constexpr std::int64_t kMaxExactInteger = std::int64_t{1} << 53;
  if (integer < -kMaxExactInteger || integer > kMaxExactInteger) return std::nullopt;
  return static_cast<double>(integer);
}

bool IsMatch(const Expression& constraint, const Offer& offer, DynamicValues& values) {
  return (offer.proxy != nullptr && offer.proxy->if_match_all) ||
         Matches(constraint, EvaluatedOffer(offer, values));
}

}  // namespace

// The offers to search, without those that the policies exclude.
struct Trader::Candidates {
  std::vector<OfferView> views{};
  Cardinalities cardinalities{};
  std::vector<std::string> limits_applied{};
  bool cut = false;  // whether there are more offers than may be searched
  bool with_proxies = true;
  bool with_dynamic = true;
  bool with_modifiable = true;
  // if with_modifiable is false: the service types to search, by name; else empty
  std::map<std::string, ServiceType> types{};

  // Returns the maximum number of steps of the search, see kMinStepsForSlot.
  std::size_t Steps(const Expression& constraint) const;
  bool Admit(const Offer& offer) const {
    return (with_proxies || offer.proxy == nullptr) &&
           (with_dynamic || !HasDynamicProperties(offer)) &&
           (with_modifiable || !HasModifiableProperties(types.at(offer.type), offer));
  }
};

// The search of one query among the candidates.
class Trader::Search {
 public:
  Search(const Candidates& candidates, const Expression& constraint, DynamicValues& values,
         MatchingOffers& matches)
      : candidates_(candidates),
        constraint_(constraint),
        column_constraint_(constraint),
        ordered_by_(PropertyToOrderBy(matches.preference)),
        values_(values),
        matches_(matches),
        left_(candidates.cardinalities.search) {}

  void Run() {
    for (const OfferView& view : matches_.offers.views()) {
      for (const auto& chunk : view.chunks()) {
        if (!Scan(*chunk)) return;
      }
    }
  }

 private:
  // Returns false when the limit of searched or found offers is reached.
  bool Scan(const OfferChunk& chunk) {
    // If the number of searched offers is limited, the result for an offer depends on the offers
    // before it. So the offers are evaluated one by one, without columns.
    const std::vector<Choice> choices =
        candidates_.cut ? std::vector<Choice>() : chunk.Choose(column_constraint_);
    const auto order = ordered_by_ != nullptr ? chunk.ColumnOf(*ordered_by_) : nullptr;
    if (!choices.empty() && candidates_.with_modifiable && Room() >= choices.size() &&
        chunk.IsPlain() &&
        std::memchr(choices.data(), static_cast<int>(Choice::kUnknown), choices.size()) ==
            nullptr) {
      TakeChosen(chunk, choices, order.get());
      return true;
    }
    for (std::size_t i = 0; i < chunk.offers().size(); ++i) {
      const Choice choice = choices.empty() ? Choice::kUnknown : choices[i];
      if (choice == Choice::kNo) continue;
      if (left_-- == 0) return false;
      const OfferPtr& offer = chunk.offers()[i];
      if (!candidates_.Admit(*offer)) continue;
      if (choice != Choice::kYes && !IsMatch(constraint_, *offer, values_)) continue;
      if (Room() == 0) {
        matches_.limits_applied.emplace_back("match_card");
        return false;
      }
      Take(offer, order != nullptr ? NumberAt(*order, i) : std::nullopt);
    }
    return true;
  }

  // Returns the number of matches that may still be added.
  std::size_t Room() const {
    return candidates_.cardinalities.match - matches_.offers.size() - matches_.proxies.size();
  }

  // Adds the chosen offers of a plain chunk, without reading the offers. The policies exclude no
  // offer of the chunk.
  void TakeChosen(const OfferChunk& chunk, const std::vector<Choice>& choices,
                  const PropertyColumn* order) {
    chosen_.resize(choices.size());
    std::size_t count = 0;
    // The loop has no branch on the choice, because the processor could not predict it.
    for (std::size_t i = 0; i < choices.size(); ++i) {
      chosen_[count] = static_cast<std::uint32_t>(i);
      count += choices[i] == Choice::kYes ? 1 : 0;
    }
    chosen_.resize(count);
    left_ -= count;
    if (order != nullptr) TakeNumbers(*order);
    matches_.offers.Add(chunk.offers(), chosen_);
  }

  // Adds the numbers of the chosen offers to `known`, up to the first unknown number.
  void TakeNumbers(const PropertyColumn& order) {
    if (matches_.known.size() != matches_.offers.size()) return;
    for (const std::uint32_t index : chosen_) {
      const auto number = NumberAt(order, index);
      if (!number) return;
      matches_.known.push_back(*number);
    }
  }

  // Returns the number by which min and max order the offer at `index`, or NaN if it has none.
  // Returns nullopt if the number must be read from the offer.
  static std::optional<double> NumberAt(const PropertyColumn& column, std::size_t index) {
    const std::uint64_t bits = column.bits()[index];
    switch (column.kinds()[index]) {
      case CellKind::kReal:
        return std::bit_cast<double>(bits);
      case CellKind::kInteger:
        return ExactNumber(static_cast<std::int64_t>(bits));
      case CellKind::kOffer:
        return std::nullopt;
      default:
        return std::numeric_limits<double>::quiet_NaN();
    }
  }

  // Adds a number to `known`, unless it or the number of an earlier offer is unknown. Rank()
  // evaluates the preference for all offers after the last known number.
  void TakeNumber(std::optional<double> number) {
    if (number && matches_.known.size() == matches_.offers.size()) {
      matches_.known.push_back(*number);
    }
  }

  void Take(const OfferPtr& offer, std::optional<double> number) {
    if (offer->proxy != nullptr) {
      matches_.proxies.push_back(offer);
      return;
    }
    TakeNumber(number);
    matches_.offers.Add(offer);
  }

  const Candidates& candidates_;
  const Expression& constraint_;
  const ColumnConstraint column_constraint_;
  const std::string* const ordered_by_;
  DynamicValues& values_;
  MatchingOffers& matches_;
  std::size_t left_;
  std::vector<std::uint32_t> chosen_;  // indices in the chunk that is being scanned
};

TradingResult<QueryResult> Trader::Find(const Query& query) const {
  DynamicValues none(nullptr, {});
  return Find(query, none);
}

TradingResult<QueryResult> Trader::Find(const Query& query, DynamicValues& values) const {
  auto matches = FindMatching(query, values);
  if (!matches) return Refuse(matches.error());
  RankedResult ranked = Rank(std::move(*matches), values);
  return QueryResult{std::move(ranked.offers).Sorted(), std::move(ranked.limits_applied)};
}

TradingResult<MatchingOffers> Trader::FindMatching(const Query& query,
                                                   DynamicValues& values) const {
  const auto type = FullyDescribeType(query.type);
  if (!type) return Refuse(type.error());
  const auto constraint = CompileConstraint(query.constraint, *type, limits_.expression);
  if (!constraint) return Refuse(constraint.error());
  auto preference = CompilePreference(query.preference, *type, limits_.expression);
  if (!preference) return Refuse(preference.error());

  Candidates candidates = SelectCandidates(query, EqualityTerms(*constraint));
  const std::size_t steps = candidates.Steps(*constraint);
  MatchingOffers matches{.offers = FoundOffers(std::move(candidates.views)),
                         .preference = std::move(*preference),
                         .cardinalities = candidates.cardinalities,
                         .limits_applied = std::move(candidates.limits_applied)};
  ScanSlot slot(steps > kMinStepsForSlot ? &scan_slots_ : nullptr);
  values.set_slot(&slot);
  Search(candidates, *constraint, values, matches).Run();
  values.set_slot(nullptr);
  return matches;
}

std::size_t Trader::Candidates::Steps(const Expression& constraint) const {
  std::size_t offers = 0;
  for (const OfferView& view : views) offers += view.size();
  return offers * constraint.nodes.size();
}

RankedResult Trader::Rank(MatchingOffers matches, DynamicValues& values) const {
  RankedResult result{broker::Rank(matches.preference, seed_++, std::move(matches.known), values,
                                   std::move(matches.offers)),
                      std::move(matches.limits_applied)};
  if (result.offers.size() > matches.cardinalities.returned) {
    result.offers.Truncate(matches.cardinalities.returned);
    result.limits_applied.emplace_back("return_card");
  }
  return result;
}

Trader::Candidates Trader::SelectCandidates(const Query& query,
                                            const std::vector<EqualityTerm>& terms) const {
  base::ReaderLock lock(mutex_);
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
  const base::WriterLock lock(mutex_);
  offers_.Index(types, terms);
}

TradingResult<std::size_t> Trader::WithdrawMatching(const std::string& type,
                                                    const std::string& constraint,
                                                    DynamicEvaluator* evaluator) {
  const auto described = FullyDescribeType(type);
  if (!described) return Refuse(described.error());
  const auto compiled = CompileConstraint(constraint, *described, limits_.expression);
  if (!compiled) return Refuse(compiled.error());

  // Searches without the lock, because the services of dynamic properties may answer slowly.
  const std::vector<OfferView> views = [&] {
    const base::ReaderLock lock(mutex_);
    return offers_.OfTypes(types_.WithSubTypes(type).value_or(std::vector<std::string>{}));
  }();
  DynamicValues values(evaluator, limits_.dynamic.query_budget);
  Offers matching;
  for (const OfferView& view : views) {
    for (const auto& chunk : view.chunks()) {
      for (const OfferPtr& offer : chunk->offers()) {
        if (offer->proxy != nullptr) continue;
        if (IsMatch(*compiled, *offer, values)) matching.push_back(offer);
      }
    }
  }

  return Change([&]() GSV_REQUIRES(mutex_) -> TradingResult<std::size_t> {
    OffersRemoved removed;
    for (const OfferPtr& offer : matching) {
      // Skips an offer that was modified after the search, because it may no longer match.
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
