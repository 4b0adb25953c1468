#include "gsv/broker/property.h"

#include <algorithm>

#include "gsv/base/check.h"

namespace gsv::broker {
namespace {

bool NameIsLess(const Property& property, std::string_view name) { return property.name < name; }

}  // namespace

PropertyList::PropertyList(std::vector<Property> properties) : properties_(std::move(properties)) {
  std::sort(properties_.begin(), properties_.end(),
            [](const Property& a, const Property& b) { return a.name < b.name; });
  GSV_CHECK(std::adjacent_find(properties_.begin(), properties_.end(),
                               [](const Property& a, const Property& b) {
                                 return a.name == b.name;
                               }) == properties_.end());
}

const Value* PropertyList::Find(std::string_view name) const {
  const auto found = std::lower_bound(properties_.begin(), properties_.end(), name, NameIsLess);
  return found != properties_.end() && found->name == name ? &found->value : nullptr;
}

void PropertyList::Set(Property property) {
  const auto place =
      std::lower_bound(properties_.begin(), properties_.end(), property.name, NameIsLess);
  if (place != properties_.end() && place->name == property.name) {
    place->value = std::move(property.value);
  } else {
    properties_.insert(place, std::move(property));
  }
}

bool PropertyList::Remove(std::string_view name) {
  const auto found = std::lower_bound(properties_.begin(), properties_.end(), name, NameIsLess);
  if (found == properties_.end() || found->name != name) return false;
  properties_.erase(found);
  return true;
}

std::size_t PropertyList::EncodedSize() const {
  std::size_t size = 0;
  for (const Property& property : properties_) {
    size += property.name.size() + 12 + property.value.EncodedSize();
  }
  return size;
}

}  // namespace gsv::broker
