#include "gsv/broker/offers/property_index.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "gsv/broker/offers/dynamic_values.h"

namespace gsv::broker {
namespace {

bool IsEarlier(const OfferPtr& a, const OfferPtr& b) { return a->number < b->number; }

Offers::iterator Place(Offers& offers, std::uint64_t number) {
  return std::lower_bound(
      offers.begin(), offers.end(), number,
      [](const OfferPtr& offer, std::uint64_t wanted) { return offer->number < wanted; });
}

std::optional<ScalarValue> ScalarOf(const Value& value) {
  if (const auto truth = value.AsBoolean()) return *truth;
  if (const auto integer = value.AsInteger()) return *integer;
  if (const auto real = value.AsReal()) return *real;
  if (const auto text = value.AsText()) return std::string(*text);
  return std::nullopt;
}

}  // namespace

void PropertyIndex::Insert(const OfferPtr& offer) {
  Offers* offers = PlaceOf(*offer);
  if (offers != nullptr) offers->insert(Place(*offers, offer->number), offer);
}

void PropertyIndex::Remove(const Offer& offer) {
  Offers* offers = PlaceOf(offer);
  if (offers == nullptr) return;
  offers->erase(Place(*offers, offer.number));
  if (!offers->empty() || offers == &uncertain_) return;
  by_value_.erase(*KeyOf(*ScalarOf(*offer.properties.Find(property_))));
}

Offers PropertyIndex::Find(const ScalarValue& value) const {
  Offers found;
  const Offers& equal = Equal(value);
  found.reserve(equal.size() + uncertain_.size());
  std::merge(equal.begin(), equal.end(), uncertain_.begin(), uncertain_.end(),
             std::back_inserter(found), IsEarlier);
  return found;
}

std::size_t PropertyIndex::Count(const ScalarValue& value) const {
  return Equal(value).size() + uncertain_.size();
}

const Offers& PropertyIndex::Equal(const ScalarValue& value) const {
  static const Offers none;
  const auto key = KeyOf(value);
  const auto found = key ? by_value_.find(*key) : by_value_.end();
  return found != by_value_.end() ? found->second : none;
}

// A long double represents every int64 and double exactly. So two numbers have the same key only if
// they are equal.
std::optional<PropertyIndex::Key> PropertyIndex::KeyOf(const ScalarValue& value) {
  if (const auto* truth = std::get_if<bool>(&value)) return *truth;
  if (const auto* integer = std::get_if<std::int64_t>(&value)) {
    return static_cast<long double>(*integer);
  }
  if (const auto* real = std::get_if<double>(&value)) {
    if (std::isnan(*real)) return std::nullopt;
    return static_cast<long double>(*real);
  }
  return std::get<std::string>(value);
}

Offers* PropertyIndex::PlaceOf(const Offer& offer) {
  if (offer.proxy != nullptr && offer.proxy->if_match_all) return &uncertain_;
  const Value* value = offer.properties.Find(property_);
  if (value == nullptr) return nullptr;
  if (IsDynamic(*value)) return &uncertain_;
  const auto scalar = ScalarOf(*value);
  const auto key = scalar ? KeyOf(*scalar) : std::nullopt;
  return key ? &by_value_[*key] : nullptr;
}

}  // namespace gsv::broker
