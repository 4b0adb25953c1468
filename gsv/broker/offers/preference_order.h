// Orders offers by a preference. `min` and `max` order by a number. With `with`, the offers for
// which the expression is TRUE come first. `random` is a random order, and `first` is the order in
// which the offers were found. Offers for which the expression has no value come last. Equal offers
// keep the order in which they were found.
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

// Found offers that are sorted as far as they are needed. A client often reads
// only the first few of many offers.
//
// Threads  any thread may call const members.
class RankedOffers {
 public:
  RankedOffers() = default;
  // Makes a list of offers that are in order already.
  explicit RankedOffers(FoundOffers offers);
  // Offers with smaller ranks come first. Offers whose rank is NaN come last. `ranks` has one rank
  // per offer.
  RankedOffers(FoundOffers offers, std::vector<double> ranks);

  std::size_t size() const { return size_; }
  // Removes the offers after the first `size`.
  void Truncate(std::size_t size);
  // Returns the first `count` offers in order, or all offers if there are fewer. The pointers are
  // invalid after ReleaseViews() and Sorted().
  std::vector<const OfferPtr*> First(std::size_t count) const;
  // See FoundOffers.
  void ReleaseViews() { offers_.ReleaseViews(); }
  // Returns all offers in order.
  FoundOffers Sorted() &&;

 private:
  FoundOffers offers_;
  std::vector<double> ranks_;  // empty if the offers are in order
  std::size_t size_ = 0;
};

// Orders `offers`. `seed` is the seed of the preference `random`. If min or max orders by a
// property, `known` has the property's value for each of the first known.size() offers. It is NaN
// for an offer without a number.
RankedOffers Rank(const Preference& preference, std::uint64_t seed, std::vector<double> known,
                  DynamicValues& values, FoundOffers offers);

}  // namespace gsv::broker
