#include "gsv/broker/offer_store.h"

#include <algorithm>

#include "gsv/base/check.h"

namespace gsv::broker {

std::uint64_t OfferStore::Add(Offer offer) {
  offer.number = next_number_++;
  const std::uint64_t number = offer.number;
  Restore(std::make_shared<const Offer>(std::move(offer)));
  return number;
}

void OfferStore::Restore(OfferPtr offer) {
  const std::uint64_t number = offer->number;
  by_type_[offer->type].emplace(number, offer);
  offers_.emplace(number, std::move(offer));
  SkipTo(number + 1);
}

void OfferStore::SkipTo(std::uint64_t number) { next_number_ = std::max(next_number_, number); }

void OfferStore::Replace(Offer offer) {
  auto stored = std::make_shared<const Offer>(std::move(offer));
  const auto found = offers_.find(stored->number);
  GSV_CHECK(found != offers_.end() && found->second->type == stored->type);
  by_type_.at(stored->type).at(stored->number) = stored;
  found->second = std::move(stored);
}

bool OfferStore::Remove(std::uint64_t number) {
  const auto found = offers_.find(number);
  if (found == offers_.end()) return false;
  const auto bucket = by_type_.find(found->second->type);
  bucket->second.erase(number);
  if (bucket->second.empty()) by_type_.erase(bucket);
  offers_.erase(found);
  return true;
}

OfferPtr OfferStore::Find(std::uint64_t number) const {
  const auto found = offers_.find(number);
  return found != offers_.end() ? found->second : nullptr;
}

Offers OfferStore::OfTypes(const std::vector<std::string>& types, std::size_t limit) const {
  Offers found;
  for (const std::string& type : types) {
    const auto bucket = by_type_.find(type);
    if (bucket == by_type_.end()) continue;
    for (const auto& [number, offer] : bucket->second) {
      if (found.size() == limit) return found;
      found.push_back(offer);
    }
  }
  return found;
}

std::size_t OfferStore::CountOfTypes(const std::vector<std::string>& types) const {
  std::size_t count = 0;
  for (const std::string& type : types) {
    const auto bucket = by_type_.find(type);
    if (bucket != by_type_.end()) count += bucket->second.size();
  }
  return count;
}

Offers OfferStore::All() const {
  Offers all;
  all.reserve(offers_.size());
  for (const auto& [number, offer] : offers_) all.push_back(offer);
  std::sort(all.begin(), all.end(),
            [](const OfferPtr& a, const OfferPtr& b) { return a->number < b->number; });
  return all;
}

}  // namespace gsv::broker
