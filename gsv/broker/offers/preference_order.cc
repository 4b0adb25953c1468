#include "gsv/broker/offers/preference_order.h"

#include <algorithm>
#include <limits>
#include <random>

#include "gsv/broker/language/evaluation.h"
#include "gsv/broker/offers/number_order.h"

namespace gsv::broker {
namespace {

// Returns the sort key of an offer. Offers with smaller keys come first, and those with NaN come
// last.
long double RankOf(const Preference& preference, const Offer& offer, DynamicValues& values) {
  constexpr long double kLast = std::numeric_limits<long double>::quiet_NaN();
  const EvaluatedOffer properties(offer, values);
  if (preference.kind == Preference::Kind::kWith) {
    return Matches(preference.expression, properties) ? 0 : kLast;
  }
  const auto number = EvaluateNumber(preference.expression, properties).value_or(kLast);
  return preference.kind == Preference::Kind::kMin ? number : -number;
}

std::vector<std::uint32_t> OrderOf(const Preference& preference, const std::vector<double>& known,
                                   DynamicValues& values, const FoundOffers& offers) {
  const double sign = preference.kind == Preference::Kind::kMin ? 1 : -1;
  if (known.size() == offers.size()) {
    std::vector<double> ranks = known;
    for (double& rank : ranks) rank *= sign;
    return AscendingOrder(std::span<const double>(ranks));
  }
  std::vector<long double> ranks;
  ranks.reserve(offers.size());
  for (const double number : known) ranks.push_back(sign * number);
  for (std::size_t i = known.size(); i < offers.size(); ++i) {
    ranks.push_back(RankOf(preference, *offers[i], values));
  }
  return AscendingOrder(ranks);
}

}  // namespace

const std::string* PropertyToOrderBy(const Preference& preference) {
  const bool by_number =
      preference.kind == Preference::Kind::kMin || preference.kind == Preference::Kind::kMax;
  if (!by_number || preference.expression.root().op != Operator::kProperty) return nullptr;
  return &preference.expression.root().property;
}

void OrderBy(const Preference& preference, std::uint64_t seed, const std::vector<double>& known,
             DynamicValues& values, FoundOffers& offers) {
  if (preference.kind == Preference::Kind::kFirst) return;
  std::vector<const OfferPtr*> places;
  if (preference.kind == Preference::Kind::kRandom) {
    places = offers.places();
    std::shuffle(places.begin(), places.end(), std::mt19937_64(seed));
  } else {
    places.reserve(offers.size());
    for (const std::uint32_t index : OrderOf(preference, known, values, offers)) {
      places.push_back(offers.places()[index]);
    }
  }
  offers.SetPlaces(std::move(places));
}

}  // namespace gsv::broker
