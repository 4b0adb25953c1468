// The offers of one service type in the order of export, which a query reads without a lock while
// others change them.
//
// Threads  a view may be read by any thread. Views are made, and the column is changed, by one
//          thread at a time (views by several, while nobody changes it).
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "gsv/broker/number_column.h"
#include "gsv/broker/offer.h"

namespace gsv::broker {

// What the column held when the view was made; some entries may be null.
class OfferView {
 public:
  explicit OfferView(Offers offers);
  OfferView(OfferView&& other) noexcept = default;
  OfferView& operator=(OfferView&& other) = delete;
  ~OfferView();

  const Offers& offers() const { return shared_->offers; }

  // What the columns say of each offer. Empty when they say nothing.
  std::vector<Choice> Choose(const std::vector<NumberTerm>& terms) const;

 private:
  friend class OfferColumn;
  struct Shared {
    Offers offers;
    NumberColumns columns;
    std::atomic<int> readers = 0;
  };
  explicit OfferView(std::shared_ptr<Shared> shared);

  std::shared_ptr<Shared> shared_;
};

class OfferColumn {
 public:
  OfferColumn() : shared_(std::make_shared<OfferView::Shared>()) {}

  std::size_t size() const { return size_; }
  OfferView View() const { return OfferView(shared_); }

  // In the place of the one with its number, or a new one.
  void Put(OfferPtr offer);
  // It must be there.
  void Remove(std::uint64_t number);

 private:
  // The offers, which nobody reads: a copy of them if somebody does.
  Offers& Own();
  std::size_t PlaceOf(std::uint64_t number) const;

  std::shared_ptr<OfferView::Shared> shared_;
  std::vector<std::uint64_t> numbers_;  // of each entry, also of those that are null
  std::size_t size_ = 0;                // of those that are not
};

}  // namespace gsv::broker
