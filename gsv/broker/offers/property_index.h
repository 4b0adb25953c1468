// Offers by the value of one property: those for which `property == value` may be TRUE.
//
// Equal are values that the constraint language calls so: numbers of every type by what they are,
// a char and a string by their text.
//
// Threads  not safe; OfferStore's.
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
  void Insert(const OfferPtr& offer);
  void Remove(const Offer& offer);

  // In the order of export: every offer whose property is equal to `value`, and those for which the
  // index does not decide: dynamic properties, and proxies that match every query.
  Offers Find(const ScalarValue& value) const;
  // How many Find() would return.
  std::size_t Count(const ScalarValue& value) const;

 private:
  using Key = std::variant<bool, long double, std::string>;

  static std::optional<Key> KeyOf(const ScalarValue& value);
  // Where an offer stands; null when no value is equal to its property's.
  Offers* PlaceOf(const Offer& offer);
  const Offers& Equal(const ScalarValue& value) const;

  const std::string property_;
  std::unordered_map<Key, Offers> by_value_;
  Offers uncertain_;
};

}  // namespace gsv::broker
