// The names of offers' properties, each list of them kept once.
//
// Threads  not safe; OfferStore's.
#pragma once

#include <memory>
#include <unordered_set>

#include "gsv/broker/language/property.h"

namespace gsv::broker {

class NameTable {
 public:
  // Has `properties` share its names with others that have the same.
  void Share(PropertyList& properties);
  // Of those that somebody uses or has used lately.
  std::size_t size() const { return known_.size(); }

 private:
  using Names = std::shared_ptr<const PropertyNames>;
  struct Hash {
    std::size_t operator()(const Names& names) const;
  };
  struct Equal {
    bool operator()(const Names& a, const Names& b) const { return *a == *b; }
  };

  void ForgetUnused();

  std::unordered_set<Names, Hash, Equal> known_;
  std::size_t enough_ = 64;  // so many are looked through for those that nobody uses
};

}  // namespace gsv::broker
