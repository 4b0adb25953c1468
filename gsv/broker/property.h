// The named values that describe an offer.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "gsv/broker/value.h"

namespace gsv::broker {

struct Property {
  std::string name;
  Value value;
};

// Where an evaluator gets properties from: an offer's own, or, for a dynamic property, another
// service. The pointer holds until the next call.
class PropertySource {
 public:
  virtual ~PropertySource() = default;
  // Null when the offer has no such property, or its value cannot be had.
  virtual const Value* Find(std::string_view name) const = 0;
};

// Properties in the order of their names, each name once.
class PropertyList : public PropertySource {
 public:
  PropertyList() = default;
  // `properties` in any order, each name at most once.
  explicit PropertyList(std::vector<Property> properties);

  const Value* Find(std::string_view name) const override;
  void Set(Property property);
  // False when there was none.
  bool Remove(std::string_view name);

  const std::vector<Property>& all() const { return properties_; }
  std::size_t EncodedSize() const;

 private:
  std::vector<Property> properties_;
};

}  // namespace gsv::broker
