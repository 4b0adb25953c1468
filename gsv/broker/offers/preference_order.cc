#include "gsv/broker/offers/preference_order.h"

#include <algorithm>
#include <limits>
#include <random>
#include <utility>

#include "gsv/base/check.h"
#include "gsv/broker/language/evaluation.h"
#include "gsv/broker/offers/number_order.h"

namespace gsv::broker {
namespace {

// Returns the sort key of an offer. Offers with smaller keys come first, and offers with the key
// NaN come last.
long double RankOf(const Preference& preference, const Offer& offer, DynamicValues& values) {
  constexpr long double kLast = std::numeric_limits<long double>::quiet_NaN();
  const EvaluatedOffer properties(offer, values);
  if (preference.kind == Preference::Kind::kWith) {
    return Matches(preference.expression, properties) ? 0 : kLast;
  }
  const auto number = EvaluateNumber(preference.expression, properties).value_or(kLast);
  return preference.kind == Preference::Kind::kMin ? number : -number;
}

std::vector<const OfferPtr*> InOrder(const FoundOffers& offers,
                                     const std::vector<std::uint32_t>& order) {
  std::vector<const OfferPtr*> places;
  places.reserve(order.size());
  for (const std::uint32_t index : order) places.push_back(offers.places()[index]);
  return places;
}

}  // namespace

const std::string* PropertyToOrderBy(const Preference& preference) {
  const bool by_number =
      preference.kind == Preference::Kind::kMin || preference.kind == Preference::Kind::kMax;
  if (!by_number || preference.expression.root().op != Operator::kProperty) return nullptr;
  return &preference.expression.root().property;
}

RankedOffers::RankedOffers(FoundOffers offers)
    : offers_(std::move(offers)), size_(offers_.size()) {}

RankedOffers::RankedOffers(FoundOffers offers, std::vector<double> ranks)
    : offers_(std::move(offers)), ranks_(std::move(ranks)), size_(offers_.size()) {
  GSV_CHECK(ranks_.size() == size_);
}

void RankedOffers::Truncate(std::size_t size) { size_ = std::min(size, size_); }

std::vector<const OfferPtr*> RankedOffers::First(std::size_t count) const {
  count = std::min(count, size_);
  if (!ranks_.empty()) return InOrder(offers_, AscendingOrder(ranks_, count));
  const auto first = offers_.places().begin();
  return {first, first + static_cast<std::ptrdiff_t>(count)};
}

FoundOffers RankedOffers::Sorted() && {
  if (!ranks_.empty()) offers_.SetPlaces(First(size_));
  offers_.Truncate(size_);
  return std::move(offers_);
}

RankedOffers Rank(const Preference& preference, std::uint64_t seed, std::vector<double> known,
                  DynamicValues& values, FoundOffers offers) {
  if (preference.kind == Preference::Kind::kFirst) return RankedOffers(std::move(offers));
  if (preference.kind == Preference::Kind::kRandom) {
    std::vector<const OfferPtr*> places = offers.places();
    std::shuffle(places.begin(), places.end(), std::mt19937_64(seed));
    offers.SetPlaces(std::move(places));
    return RankedOffers(std::move(offers));
  }
  const double sign = preference.kind == Preference::Kind::kMax ? -1 : 1;
  if (known.size() == offers.size()) {
    for (double& number : known) number *= sign;
    return RankedOffers(std::move(offers), std::move(known));
  }
  std::vector<long double> ranks;
  ranks.reserve(offers.size());
  for (const double number : known) ranks.push_back(sign * number);
  for (std::size_t i = known.size(); i < offers.size(); ++i) {
    ranks.push_back(RankOf(preference, *offers[i], values));
  }
  offers.SetPlaces(InOrder(offers, AscendingOrder(ranks)));
  return RankedOffers(std::move(offers));
}

}  // namespace gsv::broker
