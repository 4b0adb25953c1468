#include "gsv/broker/preference_order.h"

#include <algorithm>
#include <random>

#include "gsv/broker/evaluation.h"

namespace gsv::broker {
namespace {

struct Ranked {
  long double rank;     // smaller comes first
  std::uint32_t index;  // in the order in which they were found
  bool last;            // the expression has no value for this offer
};

Ranked RankOf(const Preference& preference, const Offer& offer, std::uint32_t index,
              DynamicValues& values) {
  const EvaluatedOffer properties(offer, values);
  if (preference.kind == Preference::Kind::kWith) {
    return {0, index, !Matches(preference.expression, properties)};
  }
  const auto number = EvaluateNumber(preference.expression, properties);
  const long double sign = preference.kind == Preference::Kind::kMin ? 1 : -1;
  return {sign * number.value_or(0), index, !number.has_value()};
}

void OrderByRank(const Preference& preference, DynamicValues& values, Offers& offers) {
  std::vector<Ranked> ranked;
  ranked.reserve(offers.size());
  for (const OfferPtr& offer : offers) {
    ranked.push_back(RankOf(preference, *offer, static_cast<std::uint32_t>(ranked.size()), values));
  }
  std::sort(ranked.begin(), ranked.end(), [](const Ranked& a, const Ranked& b) {
    if (a.last != b.last) return b.last;
    return a.rank != b.rank ? a.rank < b.rank : a.index < b.index;
  });
  Offers ordered;
  ordered.reserve(offers.size());
  for (const Ranked& entry : ranked) ordered.push_back(std::move(offers[entry.index]));
  offers = std::move(ordered);
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
