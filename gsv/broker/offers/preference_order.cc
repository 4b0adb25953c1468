#include "gsv/broker/offers/preference_order.h"

#include <algorithm>
#include <limits>
#include <random>

#include "gsv/broker/language/evaluation.h"
#include "gsv/broker/offers/number_order.h"

namespace gsv::broker {
namespace {

// The sort key. A smaller rank comes first, and NaN comes last.
long double RankOf(const Preference& preference, const Offer& offer, DynamicValues& values) {
  constexpr long double kLast = std::numeric_limits<long double>::quiet_NaN();
  const EvaluatedOffer properties(offer, values);
  if (preference.kind == Preference::Kind::kWith) {
    return Matches(preference.expression, properties) ? 0 : kLast;
  }
  const auto number = EvaluateNumber(preference.expression, properties).value_or(kLast);
  return preference.kind == Preference::Kind::kMin ? number : -number;
}

void OrderByRank(const Preference& preference, const std::vector<double>& known,
                 DynamicValues& values, Offers& offers) {
  const double sign = preference.kind == Preference::Kind::kMin ? 1 : -1;
  std::vector<long double> ranks;
  ranks.reserve(offers.size());
  for (const double number : known) ranks.push_back(sign * number);
  for (std::size_t i = known.size(); i < offers.size(); ++i) {
    ranks.push_back(RankOf(preference, *offers[i], values));
  }
  Offers ordered;
  ordered.reserve(offers.size());
  for (const std::uint32_t index : AscendingOrder(ranks)) {
    ordered.push_back(std::move(offers[index]));
  }
  offers = std::move(ordered);
}

}  // namespace

const std::string* PropertyToOrderBy(const Preference& preference) {
  const bool by_number =
      preference.kind == Preference::Kind::kMin || preference.kind == Preference::Kind::kMax;
  if (!by_number || preference.expression.root().op != Operator::kProperty) return nullptr;
  return &preference.expression.root().property;
}

void OrderBy(const Preference& preference, std::uint64_t seed, const std::vector<double>& known,
             DynamicValues& values, Offers& offers) {
  switch (preference.kind) {
    case Preference::Kind::kFirst:
      return;
    case Preference::Kind::kRandom:
      std::shuffle(offers.begin(), offers.end(), std::mt19937_64(seed));
      return;
    default:
      OrderByRank(preference, known, values, offers);
  }
}

}  // namespace gsv::broker
