#include "gsv/broker/offers/found_offers.h"

#include <utility>

namespace gsv::broker {
namespace {

// A list keeps its views alive if the views have at most this number of offers for each offer of
// the list. Otherwise ReleaseViews() copies the shared pointers to the offers of the list and gives
// up the views, so that the memory of all other offers can be freed.
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

void FoundOffers::ReleaseViews() {
  std::size_t kept = kept_->others.size();
  for (const OfferView& view : kept_->views) kept += view.size();
  if (kept <= kKeptForOne * size()) return;
  FoundOffers copies;
  for (const OfferPtr& offer : *this) copies.AddOther(offer);
  *this = std::move(copies);
}

}  // namespace gsv::broker
