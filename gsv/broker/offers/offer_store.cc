#include "gsv/broker/offers/offer_store.h"

#include <algorithm>

#include "gsv/base/check.h"

namespace gsv::broker {
namespace {

constexpr std::size_t kIndicesOfType = 8;
// maximum number of terms of one constraint that use an index
constexpr std::size_t kIndexedTerms = 4;

}  // namespace

std::uint64_t OfferStore::Add(Offer offer) {
  offer.number = next_number_++;
  const std::uint64_t number = offer.number;
  Restore(std::move(offer));
  return number;
}

void OfferStore::Restore(Offer restored) {
  auto offer = std::make_shared<const Offer>(std::move(restored));
  const std::uint64_t number = offer->number;
  Bucket& bucket = by_type_[offer->type];
  bucket.offers.Put(offer);
  for (PropertyIndex& index : bucket.indices) index.Insert(offer);
  offers_.Put(std::move(offer));
  SkipTo(number + 1);
}

void OfferStore::SkipTo(std::uint64_t number) { next_number_ = std::max(next_number_, number); }

void OfferStore::Replace(Offer offer) {
  auto stored = std::make_shared<const Offer>(std::move(offer));
  const OfferPtr old = offers_.Find(stored->number);
  GSV_CHECK(old != nullptr && old->type == stored->type);
  Bucket& bucket = by_type_.at(stored->type);
  for (PropertyIndex& index : bucket.indices) {
    index.Remove(*old);
    index.Insert(stored);
  }
  bucket.offers.Put(stored);
  offers_.Put(std::move(stored));
}

bool OfferStore::Remove(std::uint64_t number) {
  const OfferPtr offer = offers_.Find(number);
  if (offer == nullptr) return false;
  const auto bucket = by_type_.find(offer->type);
  for (PropertyIndex& index : bucket->second.indices) index.Remove(*offer);
  bucket->second.offers.Remove(number);
  if (bucket->second.offers.size() == 0) by_type_.erase(bucket);
  offers_.Remove(number);
  return true;
}

OfferPtr OfferStore::Find(std::uint64_t number) const { return offers_.Find(number); }

std::vector<OfferView> OfferStore::OfTypes(const std::vector<std::string>& types) const {
  std::vector<OfferView> views;
  for (const std::string& type : types) {
    const auto bucket = by_type_.find(type);
    if (bucket != by_type_.end()) views.push_back(bucket->second.offers.View());
  }
  return views;
}

std::size_t OfferStore::CountOfTypes(const std::vector<std::string>& types) const {
  std::size_t count = 0;
  for (const std::string& type : types) {
    const auto bucket = by_type_.find(type);
    if (bucket != by_type_.end()) count += bucket->second.offers.size();
  }
  return count;
}

Offers OfferStore::All() const { return offers_.All(); }

const PropertyIndex* OfferStore::Bucket::FindIndex(const std::string& property) const {
  const auto found = std::find_if(indices.begin(), indices.end(), [&](const PropertyIndex& index) {
    return index.property() == property;
  });
  return found != indices.end() ? &*found : nullptr;
}

std::optional<std::vector<OfferView>> OfferStore::OfTypesWith(
    const std::vector<std::string>& types, const std::vector<EqualityTerm>& terms) const {
  std::vector<OfferView> views;
  for (const std::string& type : types) {
    const auto bucket = by_type_.find(type);
    if (bucket == by_type_.end()) continue;
    const PropertyIndex* best = nullptr;
    const ScalarValue* value = nullptr;
    for (const EqualityTerm& term : terms) {
      const PropertyIndex* index = bucket->second.FindIndex(term.property);
      if (index == nullptr) continue;
      if (best != nullptr && best->Count(*value) <= index->Count(term.value)) continue;
      best = index;
      value = &term.value;
    }
    if (best == nullptr) return std::nullopt;
    views.emplace_back(best->Find(*value));
  }
  return views;
}

void OfferStore::Index(const std::vector<std::string>& types,
                       const std::vector<EqualityTerm>& terms) {
  for (const std::string& type : types) {
    const auto found = by_type_.find(type);
    if (found == by_type_.end()) continue;
    Bucket& bucket = found->second;
    for (std::size_t i = 0; i < std::min(terms.size(), kIndexedTerms); ++i) {
      if (bucket.FindIndex(terms[i].property) != nullptr) continue;
      if (bucket.indices.size() == kIndicesOfType) bucket.indices.pop_front();
      PropertyIndex& index = bucket.indices.emplace_back(terms[i].property);
      const OfferView view = bucket.offers.View();
      for (const auto& chunk : view.chunks()) {
        for (const OfferPtr& offer : chunk->offers()) index.Insert(offer);
      }
    }
  }
}

}  // namespace gsv::broker
