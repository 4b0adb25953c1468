// Orders offers by a preference. `min` and `max` order by a number. `with` puts the offers first
// for which the expression is TRUE. `random` is a random order, and `first` the order in which they
// were found. Offers without a value of the expression come last. Equal offers keep the order in
// which they were found.
//
// Source  OMG Trading Object Service (formal/00-06-27), "preference".
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "gsv/broker/language/expression.h"
#include "gsv/broker/offers/dynamic_values.h"
#include "gsv/broker/offers/found_offers.h"

namespace gsv::broker {

// Returns the property by which min or max orders, or null if the expression is not a single
// property.
const std::string* PropertyToOrderBy(const Preference& preference);

// Orders `offers`. `seed` is the seed of the preference `random`. If min or max orders by a
// property, `known` has the numbers of the first few offers, or NaN for an offer without a number.
void OrderBy(const Preference& preference, std::uint64_t seed, const std::vector<double>& known,
             DynamicValues& values, FoundOffers& offers);

}  // namespace gsv::broker
