// The order in which a preference returns offers.
//
// Source  OMG Trading Object Service (formal/00-06-27), "preference": min and max in the order of
//         a number, with: the offers for which it is true first, random, first: as they were
//         found. Offers for which the expression has no value come last. Otherwise equal offers
//         keep the order in which they were found.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "gsv/broker/language/expression.h"
#include "gsv/broker/language/offer.h"
#include "gsv/broker/offers/dynamic_values.h"

namespace gsv::broker {

// The property whose number min or max orders by; null when it is not one property's alone.
const std::string* PropertyToOrderBy(const Preference& preference);

// `seed` decides what random does. `known` are the numbers of the first few offers, where min or
// max orders by a property: NaN when an offer has none.
void OrderBy(const Preference& preference, std::uint64_t seed, const std::vector<double>& known,
             DynamicValues& values, Offers& offers);

}  // namespace gsv::broker
