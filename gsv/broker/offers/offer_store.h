// Stores the offers by number, by service type, and by the values of queried properties.
//
// Threads  not safe; Trader serialises access. The content of a view does not change.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "gsv/broker/language/equality_terms.h"
#include "gsv/broker/language/offer.h"
#include "gsv/broker/offers/offer_column.h"
#include "gsv/broker/offers/property_index.h"

namespace gsv::broker {

class OfferStore {
 public:
  std::size_t size() const { return offers_.size(); }

  // Adds an offer and sets its number.
  std::uint64_t Add(Offer offer);
  // Adds an offer that already has a number. No other offer may have that number.
  void Restore(Offer offer);
  // Makes the next offer get at least this number.
  void SkipTo(std::uint64_t number);
  // Replaces the offer with the same number, which must exist and have the same type.
  void Replace(Offer offer);
  // Removes an offer. Returns false if there is none with that number.
  bool Remove(std::uint64_t number);
  // Returns the offer with this number, or null if there is none.
  OfferPtr Find(std::uint64_t number) const;

  // Returns the offers of `types`, type by type, and within a type in the order of export.
  std::vector<OfferView> OfTypes(const std::vector<std::string>& types) const;
  // Returns the number of offers of `types`.
  std::size_t CountOfTypes(const std::vector<std::string>& types) const;
  // Returns all offers in the order of export.
  Offers All() const;

  // Returns offers that include all offers for which every one of `terms` is TRUE, in the order of
  // OfTypes(). For each type, the store uses the index of one term: the one that finds the fewest
  // offers. Returns nullopt if a type with offers has no index for any of the terms.
  std::optional<std::vector<OfferView>> OfTypesWith(const std::vector<std::string>& types,
                                                    const std::vector<EqualityTerm>& terms) const;
  // For each type, makes indices for the first few of `terms`. A type has only a few indices: if
  // there are too many, the oldest index is removed.
  void Index(const std::vector<std::string>& types, const std::vector<EqualityTerm>& terms);

 private:
  // The offers of one service type, and their indices.
  struct Bucket {
    OfferColumn offers{};
    std::deque<PropertyIndex> indices{};  // in the order in which they were made

    // Returns the index of a property, or null if there is none.
    const PropertyIndex* FindIndex(const std::string& property) const;
  };

  OfferColumn offers_;
  std::map<std::string, Bucket> by_type_;
  std::uint64_t next_number_ = 1;
};

}  // namespace gsv::broker
