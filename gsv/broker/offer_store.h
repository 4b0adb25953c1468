// The offers, by number and by service type.
//
// Threads  not safe; Trader serialises.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "gsv/broker/offer.h"

namespace gsv::broker {

class OfferStore {
 public:
  std::size_t size() const { return offers_.size(); }

  // Gives the offer its number.
  std::uint64_t Add(Offer offer);
  // Puts back an offer that has its number, which no other has.
  void Restore(OfferPtr offer);
  // The next offer added has at least this number.
  void SkipTo(std::uint64_t number);
  // Puts `offer` in the place of the one with its number, which must be there, of the same type.
  void Replace(Offer offer);
  // False when there is none.
  bool Remove(std::uint64_t number);
  // Null when there is none.
  OfferPtr Find(std::uint64_t number) const;

  // At most `limit` offers of one of `types`, in the order of export within a type.
  Offers OfTypes(const std::vector<std::string>& types, std::size_t limit) const;
  std::size_t CountOfTypes(const std::vector<std::string>& types) const;
  // In the order of export.
  Offers All() const;

 private:
  using Bucket = std::map<std::uint64_t, OfferPtr>;

  std::unordered_map<std::uint64_t, OfferPtr> offers_;
  std::map<std::string, Bucket> by_type_;
  std::uint64_t next_number_ = 1;
};

}  // namespace gsv::broker
