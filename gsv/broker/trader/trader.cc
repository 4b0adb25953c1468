#include "gsv/broker/trader/trader.h"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

#include "gsv/broker/trader/offer_rules.h"

namespace gsv::broker {
namespace {

constexpr std::size_t kIdLength = 8 + 1 + 16;  // the id is stem-number, in hexadecimal

std::string StemText(std::uint32_t stem) { return fmt::format("{:08x}", stem); }

template <typename Integer>
bool ReadHex(std::string_view text, Integer& value) {
  const auto read = std::from_chars(text.data(), text.data() + text.size(), value, 16);
  return read.ec == std::errc() && read.ptr == text.data() + text.size();
}

bool IsProxy(const OfferPtr& offer) { return offer->proxy != nullptr; }

}  // namespace

Trader::Trader(const TraderLimits& limits, std::uint32_t stem, std::uint64_t seed)
    : limits_(limits), stem_(stem), seed_(seed), types_(limits), links_(limits.federation.links) {
  attributes_.request_id_stem = StemText(stem);
}

base::Status Trader::Restore(TraderState state, std::unique_ptr<Journal> journal) {
  const base::WriterLock lock(mutex_);
  if (auto restored = types_.Restore(std::move(state.types), state.next_incarnation); !restored) {
    return restored;
  }
  for (Offer& offer : state.offers) offers_.Restore(std::move(offer));
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
  const base::ReaderLock lock(mutex_);
  return attributes_;
}

TradingResult<void> Trader::ChangeAttributes(const std::function<void(TraderAttributes&)>& change) {
  return Change([&]() GSV_REQUIRES(mutex_) -> TradingResult<void> {
    change(attributes_);
    Record(AttributesStored{attributes_});
    return {};
  });
}

std::uint64_t Trader::NextIncarnation() const {
  const base::ReaderLock lock(mutex_);
  return types_.next_incarnation();
}

TradingResult<std::uint64_t> Trader::AddType(ServiceType type) {
  return Change([&]() GSV_REQUIRES(mutex_) -> TradingResult<std::uint64_t> {
    const std::string name = type.name;
    auto incarnation = types_.Add(std::move(type));
    if (incarnation) RecordType(name);
    return incarnation;
  });
}

TradingResult<void> Trader::RemoveType(const std::string& name) {
  return Change([&]() GSV_REQUIRES(mutex_) -> TradingResult<void> {
    auto removed = types_.Remove(name);
    if (removed) Record(TypeRemoved{name});
    return removed;
  });
}

std::vector<std::string> Trader::ListTypes(std::optional<std::uint64_t> since) const {
  const base::ReaderLock lock(mutex_);
  return types_.List(since);
}

TradingResult<ServiceType> Trader::DescribeType(const std::string& name) const {
  const base::ReaderLock lock(mutex_);
  return types_.Describe(name);
}

TradingResult<ServiceType> Trader::FullyDescribeType(const std::string& name) const {
  const base::ReaderLock lock(mutex_);
  return types_.FullyDescribe(name);
}

TradingResult<void> Trader::MaskType(const std::string& name) {
  return Change([&]() GSV_REQUIRES(mutex_) -> TradingResult<void> {
    auto changed = types_.Mask(name);
    if (changed) RecordType(name);
    return changed;
  });
}

TradingResult<void> Trader::UnmaskType(const std::string& name) {
  return Change([&]() GSV_REQUIRES(mutex_) -> TradingResult<void> {
    auto changed = types_.Unmask(name);
    if (changed) RecordType(name);
    return changed;
  });
}

TradingResult<ServiceType> Trader::TypeForExport(const std::string& type) const {
  auto described = FullyDescribeType(type);
  if (described && described->masked) {
    return Refuse({.refusal = Refusal::kUnknownServiceType, .type = type});
  }
  return described;
}

TradingResult<std::string> Trader::Export(const std::string& type, std::string reference,
                                          std::vector<Property> properties) {
  const auto described = TypeForExport(type);
  if (!described) return Refuse(described.error());
  return Export(*described, std::move(reference), std::move(properties));
}

TradingResult<std::string> Trader::Export(const ServiceType& type, std::string reference,
                                          std::vector<Property> properties) {
  auto checked = CheckExport(type, std::move(properties), attributes().supports_dynamic_properties);
  if (!checked) return Refuse(checked.error());
  return Store(
      {.type = type.name, .reference = std::move(reference), .properties = std::move(*checked)});
}

TradingResult<std::string> Trader::Store(Offer offer) {
  if (auto fits = CheckSize(offer.properties, offer.reference); !fits) return Refuse(fits.error());
  return Change([&]() GSV_REQUIRES(mutex_) -> TradingResult<std::string> {
    if (offers_.size() >= limits_.offers) {
      return Refuse({.refusal = Refusal::kLimit,
                     .detail = fmt::format("the broker already has {} offers, which is its limit",
                                           limits_.offers)});
    }
    const std::uint64_t number = offers_.Add(std::move(offer));
    Record(OfferStored{offers_.Find(number)});
    return IdOf(number);
  });
}

TradingResult<void> Trader::Withdraw(const std::string& id) {
  return Change([&]() GSV_REQUIRES(mutex_) -> TradingResult<void> {
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

TradingResult<OfferPtr> Trader::Describe(const std::string& id) const {
  const base::ReaderLock lock(mutex_);
  return FindOffer(id);
}

TradingResult<void> Trader::Modify(const std::string& id, Modification modification) {
  return Change([&]() GSV_REQUIRES(mutex_) -> TradingResult<void> {
    if (!attributes_.supports_modifiable_properties) {
      return Refuse({.refusal = Refusal::kNotImplemented});
    }
    const auto offer = FindOffer(id);
    if (!offer) return Refuse(offer.error());
    // The type of an existing offer may have been removed. The type then has no requirements.
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

std::size_t Trader::WithdrawAll(const std::vector<std::uint64_t>& numbers) {
  const auto count = Change([&]() GSV_REQUIRES(mutex_) -> TradingResult<std::size_t> {
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
  const base::ReaderLock lock(mutex_);
  std::vector<std::string> ids;
  for (const OfferPtr& offer : offers_.All()) {
    if (!IsProxy(offer)) ids.push_back(IdOf(offer->number));
  }
  return ids;
}

Offers Trader::AllOffers() const {
  const base::ReaderLock lock(mutex_);
  Offers all = offers_.All();
  std::erase_if(all, IsProxy);
  return all;
}

TradingResult<std::uint64_t> Trader::NumberOf(const std::string& id) const {
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

TradingResult<OfferPtr> Trader::FindOffer(const std::string& id) const {
  auto offer = FindAny(id);
  if (offer && (*offer)->proxy != nullptr) {
    return Refuse({.refusal = Refusal::kProxyOfferId, .name = id});
  }
  return offer;
}

TradingResult<OfferPtr> Trader::FindAny(const std::string& id) const {
  const auto number = NumberOf(id);
  if (!number) return Refuse(number.error());
  OfferPtr offer = offers_.Find(*number);
  if (offer == nullptr) return Refuse({.refusal = Refusal::kUnknownOfferId, .name = id});
  return offer;
}

TradingResult<void> Trader::CheckSize(const PropertyList& properties,
                                      const std::string& reference) const {
  if (properties.size() > limits_.properties_per_offer) {
    return Refuse({.refusal = Refusal::kLimit,
                   .detail = fmt::format("an offer can have at most {} properties",
                                         limits_.properties_per_offer)});
  }
  const auto values = properties.values();
  if (std::count_if(values.begin(), values.end(), IsDynamic) >
      static_cast<std::ptrdiff_t>(limits_.dynamic.per_offer)) {
    return Refuse({.refusal = Refusal::kLimit,
                   .detail = fmt::format("an offer can have at most {} dynamic properties",
                                         limits_.dynamic.per_offer)});
  }
  if (properties.EncodedSize() + reference.size() / 2 > limits_.offer_bytes) {
    return Refuse(
        {.refusal = Refusal::kLimit,
         .detail = fmt::format("an offer can have at most {} bytes", limits_.offer_bytes)});
  }
  return {};
}

}  // namespace gsv::broker
