// The property names of offers. Each distinct list of names is stored once.
//
// Threads  not safe; OfferStore serialises access.
#pragma once

#include <memory>
#include <unordered_set>

#include "gsv/broker/language/property.h"

namespace gsv::broker {

class NameTable {
 public:
  // Makes `properties` share its list of names with other property lists of the same names.
  void Share(PropertyList& properties);
  // The number of lists of names that are in use or were used recently.
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
  std::size_t enough_ = 64;  // the table removes unused lists when it has this size
};

}  // namespace gsv::broker
