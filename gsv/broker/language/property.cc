#include "gsv/broker/language/property.h"

#include <algorithm>
#include <utility>

#include "gsv/base/check.h"

namespace gsv::broker {
namespace {

std::ptrdiff_t Offset(std::size_t index) { return static_cast<std::ptrdiff_t>(index); }

}  // namespace

PropertyList::PropertyList(std::vector<Property> properties) {
  std::sort(properties.begin(), properties.end(),
            [](const Property& a, const Property& b) { return a.name < b.name; });
  PropertyNames names;
  names.reserve(properties.size());
  values_.reserve(properties.size());
  for (Property& property : properties) {
    GSV_CHECK(names.empty() || names.back() != property.name);
    names.push_back(std::move(property.name));
    values_.push_back(std::move(property.value));
  }
  names_ = std::move(names);
}

PropertyList PropertyList::LastOfEachName(std::vector<Property> properties) {
  std::reverse(properties.begin(), properties.end());
  std::stable_sort(properties.begin(), properties.end(),
                   [](const Property& a, const Property& b) { return a.name < b.name; });
  const auto same = [](const Property& a, const Property& b) { return a.name == b.name; };
  properties.erase(std::unique(properties.begin(), properties.end(), same), properties.end());
  return PropertyList(std::move(properties));
}

std::size_t PropertyList::IndexOf(std::string_view name) const {
  const auto found = std::lower_bound(names_->begin(), names_->end(), name);
  return found != names_->end() && *found == name
             ? static_cast<std::size_t>(found - names_->begin())
             : size();
}

const Value* PropertyList::Find(std::string_view name) const {
  const std::size_t index = IndexOf(name);
  return index < size() ? &values_[index] : nullptr;
}

void PropertyList::Set(Property property) {
  const std::size_t known = IndexOf(property.name);
  if (known < size()) {
    values_[known] = std::move(property.value);
    return;
  }
  PropertyNames names = *names_;
  const auto place = std::lower_bound(names.begin(), names.end(), property.name);
  const auto index = place - names.begin();
  names.insert(place, std::move(property.name));
  values_.insert(values_.begin() + index, std::move(property.value));
  names_ = std::move(names);
}

bool PropertyList::Remove(std::string_view name) {
  const std::size_t index = IndexOf(name);
  if (index == size()) return false;
  PropertyNames names = *names_;
  names.erase(names.begin() + Offset(index));
  values_.erase(values_.begin() + Offset(index));
  names_ = std::move(names);
  return true;
}

std::size_t PropertyList::EncodedSize() const {
  std::size_t size = 0;
  for (const auto& [name, value] : *this) size += name.size() + 12 + value.EncodedSize();
  return size;
}

}  // namespace gsv::broker
