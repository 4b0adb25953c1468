// The offers of one service type in the order of export, which a query reads without a lock while
// others change them. They lie in chunks: a change copies a chunk that is being read, and what is
// known of the other chunks' numbers stays.
//
// Threads  a view may be read by any thread. Views are made, and the column is changed, by one
//          thread at a time (views by several, while no thread changes it).
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "gsv/broker/language/offer.h"
#include "gsv/broker/offers/number_column.h"

namespace gsv::broker {

// Some offers, and the columns of their numbers.
class OfferChunk {
 public:
  explicit OfferChunk(Offers offers) : offers_(std::move(offers)) {}

  const Offers& offers() const { return offers_; }
  // Null if the column does not exist (yet).
  std::shared_ptr<const NumberColumn> ColumnOf(const std::string& property) const;
  // What the columns say of each offer. Empty when they say nothing.
  std::vector<Choice> Choose(const std::vector<NumberTerm>& terms) const;

 private:
  friend class OfferColumn;
  friend class OfferView;

  Offers offers_;
  mutable NumberColumns columns_;
  std::atomic<int> readers_ = 0;
};

// What the column held when the view was made.
class OfferView {
 public:
  using Chunks = std::vector<std::shared_ptr<OfferChunk>>;

  explicit OfferView(Offers offers);
  OfferView(OfferView&& other) noexcept = default;
  OfferView& operator=(OfferView&& other) = delete;
  ~OfferView();

  const Chunks& chunks() const { return chunks_; }
  std::size_t size() const;

 private:
  friend class OfferColumn;
  explicit OfferView(Chunks chunks);

  Chunks chunks_;
};

class OfferColumn {
 public:
  static constexpr std::size_t kChunk = 1024;

  std::size_t size() const { return size_; }
  OfferView View() const { return OfferView(chunks_); }

  // In the place of the one with its number, or a new one.
  void Put(OfferPtr offer);
  // It must be there.
  void Remove(std::uint64_t number);

 private:
  using Place = std::pair<std::size_t, std::size_t>;  // a chunk, and where in it

  // Of the first offer in its chunk whose number is not less; the last chunk is for all beyond.
  Place PlaceOf(std::uint64_t number) const;
  // The chunk's offers, for a change.
  Offers& Own(std::size_t chunk);
  void SplitIfFull(std::size_t chunk);
  void JoinIfSmall(std::size_t chunk);

  OfferView::Chunks chunks_;  // none is empty
  std::size_t size_ = 0;
};

}  // namespace gsv::broker
