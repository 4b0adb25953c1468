#include "gsv/broker/offers/offer_column.h"

#include <algorithm>
#include <iterator>

#include "gsv/base/check.h"

namespace gsv::broker {
namespace {

// A chunk with fewer offers has no property columns. Its offers are evaluated one by one.
constexpr std::size_t kMinOffersForColumns = OfferColumn::kChunk / 4;

bool IsBefore(const OfferPtr& offer, std::uint64_t number) { return offer->number < number; }

}  // namespace

std::shared_ptr<const PropertyColumn> OfferChunk::ColumnOf(const std::string& property) const {
  return offers_.size() < kMinOffersForColumns ? nullptr : columns_.Of(offers_, property);
}

std::vector<Choice> OfferChunk::Choose(const ColumnConstraint& constraint) const {
  ColumnConstraint::Columns columns;
  columns.reserve(constraint.properties().size());
  for (const std::string& property : constraint.properties()) {
    columns.push_back(ColumnOf(property));
  }
  std::vector<Choice> choices = constraint.Choose(columns, offers_.size());
  if (IsPlain()) return choices;
  // A proxy may match every constraint, whatever its properties are. So the columns cannot decide
  // whether it matches.
  for (std::size_t i = 0; i < choices.size(); ++i) {
    if (offers_[i]->proxy != nullptr) choices[i] = Choice::kUnknown;
  }
  return choices;
}

OfferView::OfferView(Offers offers)
    : OfferView(Chunks{std::make_shared<OfferChunk>(std::move(offers))}) {}

OfferView::OfferView(Chunks chunks) : chunks_(std::move(chunks)) {
  for (const auto& chunk : chunks_) ++chunk->readers_;
}

OfferView::~OfferView() {
  for (const auto& chunk : chunks_) --chunk->readers_;
}

std::size_t OfferView::size() const {
  std::size_t size = 0;
  for (const auto& chunk : chunks_) size += chunk->offers().size();
  return size;
}

OfferPtr OfferColumn::Find(std::uint64_t number) const {
  if (chunks_.empty()) return nullptr;
  const auto [chunk, index] = PlaceOf(number);
  const Offers& offers = chunks_[chunk]->offers_;
  return index < offers.size() && offers[index]->number == number ? offers[index] : nullptr;
}

Offers OfferColumn::All() const {
  Offers all;
  all.reserve(size_);
  for (const auto& chunk : chunks_) {
    all.insert(all.end(), chunk->offers_.begin(), chunk->offers_.end());
  }
  return all;
}

void OfferColumn::Put(OfferPtr offer) {
  if (chunks_.empty()) chunks_.push_back(std::make_shared<OfferChunk>(Offers{}));
  const auto [chunk, index] = PlaceOf(offer->number);
  Offers& offers = Own(chunk);
  if (index < offers.size() && offers[index]->number == offer->number) {
    offers[index] = std::move(offer);
    return;
  }
  offers.insert(offers.begin() + static_cast<std::ptrdiff_t>(index), std::move(offer));
  ++size_;
  SplitIfFull(chunk);
}

void OfferColumn::Remove(std::uint64_t number) {
  GSV_CHECK(!chunks_.empty());
  const auto [chunk, index] = PlaceOf(number);
  Offers& offers = Own(chunk);
  GSV_CHECK(index < offers.size() && offers[index]->number == number);
  offers.erase(offers.begin() + static_cast<std::ptrdiff_t>(index));
  --size_;
  JoinIfSmall(chunk);
}

OfferColumn::Place OfferColumn::PlaceOf(std::uint64_t number) const {
  const auto found = std::lower_bound(
      chunks_.begin(), std::prev(chunks_.end()), number,
      [](const auto& chunk, std::uint64_t n) { return IsBefore(chunk->offers_.back(), n); });
  const Offers& offers = (*found)->offers_;
  const auto place = std::lower_bound(offers.begin(), offers.end(), number, IsBefore);
  return {static_cast<std::size_t>(found - chunks_.begin()),
          static_cast<std::size_t>(place - offers.begin())};
}

Offers& OfferColumn::Own(std::size_t chunk) {
  std::shared_ptr<OfferChunk>& own = chunks_[chunk];
  if (own->readers_ != 0) own = std::make_shared<OfferChunk>(own->offers_);
  own->columns_.Clear();
  return own->offers_;
}

// Exports enlarge only the last chunk. If the last chunk is full, it is not split: the new offer
// begins a new chunk.
void OfferColumn::SplitIfFull(std::size_t chunk) {
  Offers& offers = chunks_[chunk]->offers_;
  if (offers.size() <= kChunk) return;
  const bool last = chunk + 1 == chunks_.size();
  const auto middle = last ? std::prev(offers.end())
                           : offers.begin() + static_cast<std::ptrdiff_t>(offers.size() / 2);
  Offers rest(std::make_move_iterator(middle), std::make_move_iterator(offers.end()));
  offers.erase(middle, offers.end());
  offers.shrink_to_fit();
  chunks_.insert(chunks_.begin() + static_cast<std::ptrdiff_t>(chunk + 1),
                 std::make_shared<OfferChunk>(std::move(rest)));
}

void OfferColumn::JoinIfSmall(std::size_t chunk) {
  const auto at = [&](std::size_t index) {
    return chunks_.begin() + static_cast<std::ptrdiff_t>(index);
  };
  const std::size_t left = chunks_[chunk]->offers_.size();
  if (left == 0) {
    chunks_.erase(at(chunk));
    return;
  }
  if (left > kChunk / 4 || chunk == 0) return;
  const std::size_t before = chunks_[chunk - 1]->offers_.size();
  if (before + left > kChunk / 2) return;
  Offers& joined = Own(chunk - 1);
  const Offers& offers = chunks_[chunk]->offers_;
  joined.insert(joined.end(), offers.begin(), offers.end());
  chunks_.erase(at(chunk));
}

}  // namespace gsv::broker
