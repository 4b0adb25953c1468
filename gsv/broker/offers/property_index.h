// An index of offers by the value of one property. It finds the offers for which
// `property == value` may be TRUE.
//
// Values are equal as in the constraint language: numbers of all types by their value, and char and
// string by their text.
// Threads  not safe; OfferStore serialises access.
#pragma once

#include <optional>
#include <string>
#include <unordered_map>
#include <variant>

#include "gsv/broker/language/offer.h"

namespace gsv::broker {

class PropertyIndex {
 public:
  explicit PropertyIndex(std::string property) : property_(std::move(property)) {}

  const std::string& property() const { return property_; }
  // Adds an offer to the index.
  void Insert(const OfferPtr& offer);
  // Removes an offer from the index.
  void Remove(const Offer& offer);

  // Returns, in the order of export, the offers whose property is equal to `value`. Also returns
  // the offers whose property is dynamic, and proxies that match every query, because the index
  // cannot decide for them.
  Offers Find(const ScalarValue& value) const;
  // The number of offers that Find() returns.
  std::size_t Count(const ScalarValue& value) const;

 private:
  using Key = std::variant<bool, long double, std::string>;

  // Returns nullopt for NaN, which is equal to no value.
  static std::optional<Key> KeyOf(const ScalarValue& value);
  // Returns the list that contains the offer, or null if its property has no value to index.
  Offers* PlaceOf(const Offer& offer);
  // Returns the offers whose stored property is equal to `value`, without uncertain_.
  const Offers& Equal(const ScalarValue& value) const;

  const std::string property_;
  std::unordered_map<Key, Offers> by_value_;
  Offers uncertain_;  // offers that Find() returns for every value
};

}  // namespace gsv::broker
