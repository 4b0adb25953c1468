// Properties: the named values that describe an offer.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gsv/broker/language/interned.h"
#include "gsv/broker/language/value.h"

namespace gsv::broker {

struct Property {
  std::string name;
  Value value;
};

// The source from which an evaluator gets properties: the offer itself, or another service for a
// dynamic property.
class PropertySource {
 public:
  virtual ~PropertySource() = default;
  // Returns null if the offer has no such property, or if its value is not available. The returned
  // pointer is valid until the next call of Find().
  virtual const Value* Find(std::string_view name) const = 0;
};

// Sorted; each name occurs once.
using PropertyNames = std::vector<std::string>;

// Properties sorted by name; each name occurs once. The names are stored apart from the values, so
// that offers with the same names share them.
class PropertyList : public PropertySource {
 public:
  // One property, as a view into the list.
  struct Entry {
    const std::string& name;
    const Value& value;
  };
  class Iterator {
   public:
    Iterator(const PropertyList& list, std::size_t index) : list_(&list), index_(index) {}
    Entry operator*() const { return (*list_)[index_]; }
    Iterator& operator++() {
      ++index_;
      return *this;
    }
    bool operator==(const Iterator& other) const { return index_ == other.index_; }

   private:
    const PropertyList* list_;  // the list that this iterator reads
    std::size_t index_;
  };

  PropertyList() = default;
  // `properties` may be in any order. Each name occurs at most once.
  explicit PropertyList(std::vector<Property> properties);
  // `properties` may be in any order. If a name occurs several times, the last value applies.
  static PropertyList LastOfEachName(std::vector<Property> properties);

  const Value* Find(std::string_view name) const override;
  // Adds the property, or replaces the value of the property with that name.
  void Set(Property property);
  // Removes a property. Returns false if there is none with that name.
  bool Remove(std::string_view name);

  std::size_t size() const { return values_.size(); }
  Entry operator[](std::size_t index) const { return {(*names_)[index], values_[index]}; }
  Iterator begin() const { return {*this, 0}; }
  Iterator end() const { return {*this, size()}; }
  // The index of the property with that name, or size() if there is none.
  std::size_t IndexOf(std::string_view name) const;

  // The names in the order of the values.
  const Interned<PropertyNames>& names() const { return names_; }
  std::span<const Value> values() const { return values_; }

  // An upper bound of the encoded size of all properties, in bytes.
  std::size_t EncodedSize() const;

 private:
  Interned<PropertyNames> names_;
  std::vector<Value> values_;
};

}  // namespace gsv::broker
