#include "gsv/broker/trader.h"

#include <algorithm>
#include <charconv>
#include <functional>
#include <iterator>
#include <map>

#include <fmt/format.h>

#include "gsv/broker/evaluation.h"
#include "gsv/broker/offer_rules.h"
#include "gsv/broker/preference_order.h"
#include "gsv/broker/query_compilation.h"

namespace gsv::broker {
namespace {

using ReadLock = std::shared_lock<std::shared_mutex>;
using WriteLock = std::unique_lock<std::shared_mutex>;

constexpr std::size_t kIdLength = 8 + 1 + 16;  // stem-number, in hexadecimal

std::string StemText(std::uint32_t stem) { return fmt::format("{:08x}", stem); }

template <typename Integer>
bool ReadHex(std::string_view text, Integer& value) {
  const auto read = std::from_chars(text.data(), text.data() + text.size(), value, 16);
  return read.ec == std::errc() && read.ptr == text.data() + text.size();
}

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

bool IsProxy(const OfferPtr& offer) { return offer->proxy != nullptr; }

bool IsMatch(const Expression& constraint, const Offer& offer, DynamicValues& values) {
  return (offer.proxy != nullptr && offer.proxy->if_match_all) ||
         Matches(constraint, EvaluatedOffer(offer, values));
}

// Keeps the offers that match, up to `limit`; true when there were more.
bool KeepMatching(const Expression& constraint, std::size_t limit, DynamicValues& values,
                  Offers& offers) {
  std::size_t kept = 0;
  for (OfferPtr& offer : offers) {
    if (!IsMatch(constraint, *offer, values)) continue;
    if (kept == limit) {
      offers.resize(kept);
      return true;
    }
    if (&offers[kept] != &offer) offers[kept] = std::move(offer);
    ++kept;
  }
  offers.resize(kept);
  return false;
}

}  // namespace

Trader::Trader(const TraderLimits& limits, std::uint32_t stem, std::uint64_t seed)
    : limits_(limits), stem_(stem), seed_(seed), types_(limits), links_(limits.federation.links) {
  attributes_.request_id_stem = StemText(stem);
}

base::Status Trader::Restore(TraderState state, std::unique_ptr<Journal> journal) {
  const WriteLock lock(mutex_);
  if (auto restored = types_.Restore(std::move(state.types), state.next_incarnation); !restored) {
    return restored;
  }
  for (OfferPtr& offer : state.offers) offers_.Restore(std::move(offer));
  offers_.SkipTo(state.next_number);
  for (TraderLink& link : state.links) links_.Restore(std::move(link));
  attributes_ = std::move(state.attributes);
  if (attributes_.request_id_stem.empty()) attributes_.request_id_stem = StemText(state.stem);
  stem_ = state.stem;
  journal_ = std::move(journal);
  return {};
}

void Trader::RecordType(const std::string& name) {
  if (auto type = types_.Describe(name)) Record(TypeStored{std::move(*type)});
}

TraderAttributes Trader::attributes() const {
  const ReadLock lock(mutex_);
  return attributes_;
}

Traded<void> Trader::ChangeAttributes(const std::function<void(TraderAttributes&)>& change) {
  return Change([&]() -> Traded<void> {
    change(attributes_);
    Record(AttributesStored{attributes_});
    return {};
  });
}

std::uint64_t Trader::NextIncarnation() const {
  const ReadLock lock(mutex_);
  return types_.next_incarnation();
}

Traded<std::uint64_t> Trader::AddType(ServiceType type) {
  return Change([&]() -> Traded<std::uint64_t> {
    const std::string name = type.name;
    auto incarnation = types_.Add(std::move(type));
    if (incarnation) RecordType(name);
    return incarnation;
  });
}

Traded<void> Trader::RemoveType(const std::string& name) {
  return Change([&]() -> Traded<void> {
    auto removed = types_.Remove(name);
    if (removed) Record(TypeRemoved{name});
    return removed;
  });
}

std::vector<std::string> Trader::ListTypes(std::optional<std::uint64_t> since) const {
  const ReadLock lock(mutex_);
  return types_.List(since);
}

Traded<ServiceType> Trader::DescribeType(const std::string& name) const {
  const ReadLock lock(mutex_);
  return types_.Describe(name);
}

Traded<ServiceType> Trader::FullyDescribeType(const std::string& name) const {
  const ReadLock lock(mutex_);
  return types_.FullyDescribe(name);
}

Traded<void> Trader::MaskType(const std::string& name) {
  return Change([&]() -> Traded<void> {
    auto changed = types_.Mask(name);
    if (changed) RecordType(name);
    return changed;
  });
}

Traded<void> Trader::UnmaskType(const std::string& name) {
  return Change([&]() -> Traded<void> {
    auto changed = types_.Unmask(name);
    if (changed) RecordType(name);
    return changed;
  });
}

Traded<ServiceType> Trader::TypeForExport(const std::string& type) const {
  auto described = FullyDescribeType(type);
  if (described && described->masked) {
    return Refuse({.refusal = Refusal::kUnknownServiceType, .type = type});
  }
  return described;
}

Traded<std::string> Trader::Export(const std::string& type, std::string reference,
                                   std::vector<Property> properties) {
  const auto described = TypeForExport(type);
  if (!described) return Refuse(described.error());
  auto checked =
      CheckExport(*described, std::move(properties), attributes().supports_dynamic_properties);
  if (!checked) return Refuse(checked.error());
  return Store(
      {.type = type, .reference = std::move(reference), .properties = std::move(*checked)});
}

Traded<std::string> Trader::Store(Offer offer) {
  if (auto fits = CheckSize(offer.properties, offer.reference); !fits) return Refuse(fits.error());
  return Change([&]() -> Traded<std::string> {
    if (offers_.size() >= limits_.offers) {
      return Refuse({.refusal = Refusal::kLimit,
                     .detail = fmt::format("there are {} offers already", limits_.offers)});
    }
    const std::uint64_t number = offers_.Add(std::move(offer));
    Record(OfferStored{offers_.Find(number)});
    return IdOf(number);
  });
}

Traded<void> Trader::Withdraw(const std::string& id) {
  return Change([&]() -> Traded<void> {
    const auto offer = FindOffer(id);
    if (!offer) return Refuse(offer.error());
    Remove({(*offer)->number});
    return {};
  });
}

void Trader::Remove(std::vector<std::uint64_t> numbers) {
  for (const std::uint64_t number : numbers) offers_.Remove(number);
  Record(OffersRemoved{std::move(numbers)});
}

Traded<OfferPtr> Trader::Describe(const std::string& id) const {
  const ReadLock lock(mutex_);
  return FindOffer(id);
}

Traded<void> Trader::Modify(const std::string& id, Modification modification) {
  return Change([&]() -> Traded<void> {
    if (!attributes_.supports_modifiable_properties) {
      return Refuse({.refusal = Refusal::kNotImplemented});
    }
    const auto offer = FindOffer(id);
    if (!offer) return Refuse(offer.error());
    // The type of a living offer may have been removed meanwhile; it then demands nothing.
    const ServiceType type =
        types_.FullyDescribe((*offer)->type).value_or(ServiceType{.name = (*offer)->type});
    auto modified = CheckModification(type, (*offer)->properties, std::move(modification),
                                      attributes_.supports_dynamic_properties);
    if (!modified) return Refuse(modified.error());
    if (auto fits = CheckSize(*modified, (*offer)->reference); !fits) return fits;
    const std::uint64_t number = (*offer)->number;
    offers_.Replace({.number = number,
                     .type = (*offer)->type,
                     .reference = (*offer)->reference,
                     .properties = std::move(*modified)});
    Record(OfferStored{offers_.Find(number)});
    return {};
  });
}

Traded<std::size_t> Trader::WithdrawMatching(const std::string& type, const std::string& constraint,
                                             DynamicEvaluator* evaluator) {
  const auto described = FullyDescribeType(type);
  if (!described) return Refuse(described.error());
  const auto compiled = CompileConstraint(constraint, *described, limits_.expression);
  if (!compiled) return Refuse(compiled.error());

  // Services are asked for dynamic properties without the lock.
  Offers matching = [&] {
    const ReadLock lock(mutex_);
    return offers_.OfTypes(types_.WithSubTypes(type).value_or(std::vector<std::string>{}),
                           limits_.offers);
  }();
  std::erase_if(matching, IsProxy);
  DynamicValues values(evaluator, limits_.dynamic.query_budget);
  KeepMatching(*compiled, limits_.offers, values, matching);

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

std::size_t Trader::WithdrawAll(const std::vector<std::uint64_t>& numbers) {
  const auto count = Change([&]() -> Traded<std::size_t> {
    OffersRemoved removed;
    for (const std::uint64_t number : numbers) {
      if (offers_.Remove(number)) removed.numbers.push_back(number);
    }
    const std::size_t size = removed.numbers.size();
    if (size > 0) Record(std::move(removed));
    return size;
  });
  return count.value_or(0);
}

std::vector<std::string> Trader::OfferIds() const {
  const ReadLock lock(mutex_);
  std::vector<std::string> ids;
  for (const OfferPtr& offer : offers_.All()) {
    if (!IsProxy(offer)) ids.push_back(IdOf(offer->number));
  }
  return ids;
}

Offers Trader::AllOffers() const {
  const ReadLock lock(mutex_);
  Offers all = offers_.All();
  std::erase_if(all, IsProxy);
  return all;
}

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

  MatchingOffers matches = Candidates(query);
  matches.preference = std::move(*preference);
  if (KeepMatching(*constraint, matches.cardinalities.match, values, matches.offers)) {
    matches.limits_applied.emplace_back("match_card");
  }
  const auto proxies =
      std::stable_partition(matches.offers.begin(), matches.offers.end(), std::not_fn(IsProxy));
  std::move(proxies, matches.offers.end(), std::back_inserter(matches.proxies));
  matches.offers.erase(proxies, matches.offers.end());
  return matches;
}

QueryResult Trader::Rank(MatchingOffers matches, DynamicValues& values) const {
  OrderBy(matches.preference, seed_++, values, matches.offers);
  if (matches.offers.size() > matches.cardinalities.returned) {
    matches.offers.resize(matches.cardinalities.returned);
    matches.limits_applied.emplace_back("return_card");
  }
  return {std::move(matches.offers), std::move(matches.limits_applied)};
}

MatchingOffers Trader::Candidates(const Query& query) const {
  const ReadLock lock(mutex_);
  MatchingOffers candidates{.cardinalities = EffectiveCardinalities(query.policies, attributes_)};
  const std::size_t search_card = candidates.cardinalities.search;
  std::vector<std::string> types = {query.type};
  if (!query.policies.exact_type_match) {
    types = types_.WithSubTypes(query.type).value_or(types);
  }
  candidates.offers = offers_.OfTypes(types, search_card);
  if (offers_.CountOfTypes(types) > search_card) {
    candidates.limits_applied.emplace_back("search_card");
  }
  if (!query.policies.use_proxy_offers || !attributes_.supports_proxy_offers) {
    std::erase_if(candidates.offers, IsProxy);
  }
  if (!query.policies.use_dynamic_properties || !attributes_.supports_dynamic_properties) {
    std::erase_if(candidates.offers,
                  [](const OfferPtr& offer) { return HasDynamicProperties(*offer); });
  }
  if (!query.policies.use_modifiable_properties && attributes_.supports_modifiable_properties) {
    std::map<std::string_view, ServiceType> described;
    for (const std::string& name : types) {
      described.emplace(name, types_.FullyDescribe(name).value_or(ServiceType{.name = name}));
    }
    std::erase_if(candidates.offers, [&](const OfferPtr& offer) {
      return HasModifiableProperties(described.at(offer->type), *offer);
    });
  }
  return candidates;
}

Traded<std::uint64_t> Trader::NumberOf(const std::string& id) const {
  std::uint32_t stem = 0;
  std::uint64_t number = 0;
  const std::string_view text = id;
  if (text.size() != kIdLength || text[8] != '-' || !ReadHex(text.substr(0, 8), stem) ||
      !ReadHex(text.substr(9), number)) {
    return Refuse({.refusal = Refusal::kIllegalOfferId, .name = id});
  }
  if (stem != stem_) return Refuse({.refusal = Refusal::kUnknownOfferId, .name = id});
  return number;
}

std::string Trader::IdOf(std::uint64_t number) const {
  return fmt::format("{:08x}-{:016x}", stem_, number);
}

Traded<OfferPtr> Trader::FindOffer(const std::string& id) const {
  auto offer = FindAny(id);
  if (offer && (*offer)->proxy != nullptr) {
    return Refuse({.refusal = Refusal::kProxyOfferId, .name = id});
  }
  return offer;
}

Traded<OfferPtr> Trader::FindAny(const std::string& id) const {
  const auto number = NumberOf(id);
  if (!number) return Refuse(number.error());
  OfferPtr offer = offers_.Find(*number);
  if (offer == nullptr) return Refuse({.refusal = Refusal::kUnknownOfferId, .name = id});
  return offer;
}

Traded<void> Trader::CheckSize(const PropertyList& properties, const std::string& reference) const {
  if (properties.all().size() > limits_.properties_per_offer) {
    return Refuse({.refusal = Refusal::kLimit,
                   .detail = fmt::format("an offer has more than {} properties",
                                         limits_.properties_per_offer)});
  }
  const auto& all = properties.all();
  if (std::count_if(all.begin(), all.end(), [](const Property& property) {
        return IsDynamic(property.value);
      }) > static_cast<std::ptrdiff_t>(limits_.dynamic.per_offer)) {
    return Refuse({.refusal = Refusal::kLimit,
                   .detail = fmt::format("an offer has more than {} dynamic properties",
                                         limits_.dynamic.per_offer)});
  }
  if (properties.EncodedSize() + reference.size() / 2 > limits_.offer_bytes) {
    return Refuse(
        {.refusal = Refusal::kLimit,
         .detail = fmt::format("an offer takes more than {} bytes", limits_.offer_bytes)});
  }
  return {};
}

}  // namespace gsv::broker
