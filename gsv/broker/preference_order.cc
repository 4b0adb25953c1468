#include "gsv/broker/preference_order.h"

#include <algorithm>
#include <random>

#include "gsv/broker/evaluation.h"

namespace gsv::broker {
namespace {

struct Ranked {
  bool last;         // the expression has no value for this offer
  long double rank;  // smaller comes first
  OfferPtr offer;
};

Ranked RankOf(const Preference& preference, OfferPtr offer, DynamicValues& values) {
  const EvaluatedOffer properties(*offer, values);
  if (preference.kind == Preference::Kind::kWith) {
    const bool matches = Matches(preference.expression, properties);
    return {!matches, 0, std::move(offer)};
  }
  const auto number = EvaluateNumber(preference.expression, properties);
  const long double sign = preference.kind == Preference::Kind::kMin ? 1 : -1;
  return {!number.has_value(), sign * number.value_or(0), std::move(offer)};
}

void OrderByRank(const Preference& preference, DynamicValues& values, Offers& offers) {
  std::vector<Ranked> ranked;
  ranked.reserve(offers.size());
  for (OfferPtr& offer : offers) {
    ranked.push_back(RankOf(preference, std::move(offer), values));
  }
  std::stable_sort(ranked.begin(), ranked.end(), [](const Ranked& a, const Ranked& b) {
    return a.last != b.last ? b.last : a.rank < b.rank;
  });
  std::transform(ranked.begin(), ranked.end(), offers.begin(),
                 [](Ranked& entry) { return std::move(entry.offer); });
}

}  // namespace

void OrderBy(const Preference& preference, std::uint64_t seed, DynamicValues& values,
             Offers& offers) {
  switch (preference.kind) {
    case Preference::Kind::kFirst:
      return;
    case Preference::Kind::kRandom:
      std::shuffle(offers.begin(), offers.end(), std::mt19937_64(seed));
      return;
    default:
      OrderByRank(preference, values, offers);
  }
}

}  // namespace gsv::broker
