#include "gsv/broker/offer_column.h"

#include <algorithm>

#include "gsv/base/check.h"

namespace gsv::broker {
namespace {

// Fewer empty entries than this are not worth moving the others for.
constexpr std::size_t kFewest = 64;
// Fewer offers are looked through one by one.
constexpr std::size_t kWorthColumns = 1024;

}  // namespace

OfferView::OfferView(Offers offers) : shared_(std::make_shared<Shared>()) {
  shared_->offers = std::move(offers);
  ++shared_->readers;
}

OfferView::OfferView(std::shared_ptr<Shared> shared) : shared_(std::move(shared)) {
  ++shared_->readers;
}

OfferView::~OfferView() {
  if (shared_ != nullptr) --shared_->readers;
}

std::vector<Choice> OfferView::Choose(const std::vector<NumberTerm>& terms) const {
  std::vector<Choice> choices;
  if (offers().size() < kWorthColumns) return choices;
  bool decided = true;
  for (const NumberTerm& term : terms) {
    const auto column = shared_->columns.Of(offers(), term.property);
    if (column == nullptr) {
      decided = false;
      continue;
    }
    if (choices.empty()) choices.resize(offers().size(), Choice::kYes);
    column->Narrow(term, choices);
  }
  if (!decided) std::replace(choices.begin(), choices.end(), Choice::kYes, Choice::kUnknown);
  return choices;
}

void OfferColumn::Put(OfferPtr offer) {
  const std::size_t place = PlaceOf(offer->number);
  const auto at = static_cast<std::ptrdiff_t>(place);
  Offers& offers = Own();
  if (place < numbers_.size() && numbers_[place] == offer->number) {
    if (offers[place] == nullptr) ++size_;
    offers[place] = std::move(offer);
    return;
  }
  numbers_.insert(numbers_.begin() + at, offer->number);
  offers.insert(offers.begin() + at, std::move(offer));
  ++size_;
}

void OfferColumn::Remove(std::uint64_t number) {
  const std::size_t place = PlaceOf(number);
  Offers& offers = Own();
  GSV_CHECK(place < numbers_.size() && numbers_[place] == number && offers[place] != nullptr);
  offers[place] = nullptr;
  --size_;
  if (offers.size() - size_ < std::max(kFewest, size_)) return;
  std::erase(offers, nullptr);
  numbers_.clear();
  for (const OfferPtr& offer : offers) numbers_.push_back(offer->number);
}

Offers& OfferColumn::Own() {
  if (shared_->readers != 0) {
    auto copy = std::make_shared<OfferView::Shared>();
    copy->offers = shared_->offers;
    shared_ = std::move(copy);
  } else {
    shared_->columns.Clear();
  }
  return shared_->offers;
}

std::size_t OfferColumn::PlaceOf(std::uint64_t number) const {
  return static_cast<std::size_t>(std::lower_bound(numbers_.begin(), numbers_.end(), number) -
                                  numbers_.begin());
}

}  // namespace gsv::broker
