#include "gsv/broker/offers/found_offers.h"

#include <utility>

namespace gsv::broker {
namespace {

// From() shares the views if they have at most this number of offers for each remaining offer.
// Otherwise it copies the remaining offers, so that the memory of the other offers can be freed.
constexpr std::size_t kKeptForOne = 4;

}  // namespace

FoundOffers::FoundOffers(std::vector<OfferView> views)
    : kept_(std::make_shared<KeptOffers>(KeptOffers{.views = std::move(views)})) {}

void FoundOffers::Add(const Offers& chunk, std::span<const std::uint32_t> indices) {
  const std::size_t before = places_.size();
  places_.resize(before + indices.size());
  const OfferPtr** place = places_.data() + before;
  for (const std::uint32_t index : indices) *place++ = &chunk[index];
}

void FoundOffers::AddOther(OfferPtr offer) { Add(kept_->others.emplace_back(std::move(offer))); }

void FoundOffers::Truncate(std::size_t size) {
  if (size < places_.size()) places_.resize(size);
}

FoundOffers FoundOffers::From(std::size_t first) const {
  std::size_t kept = kept_->others.size();
  for (const OfferView& view : kept_->views) kept += view.size();
  FoundOffers rest;
  if (kept > kKeptForOne * (size() - first)) {
    for (std::size_t i = first; i < size(); ++i) rest.AddOther((*this)[i]);
    return rest;
  }
  rest.kept_ = kept_;
  rest.places_.assign(places_.begin() + static_cast<std::ptrdiff_t>(first), places_.end());
  return rest;
}

}  // namespace gsv::broker
