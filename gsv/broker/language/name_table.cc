#include "gsv/broker/language/name_table.h"

#include <algorithm>
#include <functional>
#include <string_view>

namespace gsv::broker {

std::size_t NameTable::Hash::operator()(const Names& names) const {
  std::size_t hash = names->size();
  for (const std::string& name : *names) {
    hash = hash * 31 + std::hash<std::string_view>()(name);
  }
  return hash;
}

void NameTable::Share(PropertyList& properties) {
  const auto [known, is_new] = known_.insert(properties.names());
  if (!is_new) return properties.ShareNames(*known);
  if (known_.size() > enough_) ForgetUnused();
}

// A list of names that only this table uses can be removed: no other thread can start to use it at
// the same time.
void NameTable::ForgetUnused() {
  std::erase_if(known_, [](const Names& names) { return names.use_count() == 1; });
  enough_ = std::max(enough_, 2 * known_.size());
}

}  // namespace gsv::broker
