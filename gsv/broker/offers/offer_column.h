// The offers of one service type in the order of export. A query reads them without a lock while
// other threads change them. The offers are stored in chunks: a change copies a chunk that is being
// read, and the number columns of all other chunks stay.
//
// Threads  any thread may read a view. One thread at a time changes the column; several threads may
//          make views while none changes it.
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

// Some offers, and their number columns.
class OfferChunk {
 public:
  explicit OfferChunk(Offers offers) : offers_(std::move(offers)) {}

  const Offers& offers() const { return offers_; }
  // Null if the column does not exist (yet).
  std::shared_ptr<const NumberColumn> ColumnOf(const std::string& property) const;
  // The state of each offer by the columns; empty if there is no column for the terms.
  std::vector<Choice> Choose(const std::vector<NumberTerm>& terms) const;

 private:
  friend class OfferColumn;
  friend class OfferView;

  Offers offers_;
  mutable NumberColumns columns_;
  std::atomic<int> readers_ = 0;
};

// The content of the column when the view was made.
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

  // Adds the offer, or replaces the one with its number.
  void Put(OfferPtr offer);
  // Removes an offer, which must exist.
  void Remove(std::uint64_t number);

 private:
  using Place = std::pair<std::size_t, std::size_t>;  // chunk, and index in the chunk

  // The place of the first offer whose number is not less, in the chunk of `number`. Numbers above
  // all others belong to the last chunk.
  Place PlaceOf(std::uint64_t number) const;
  // The chunk's offers, to be changed.
  Offers& Own(std::size_t chunk);
  void SplitIfFull(std::size_t chunk);
  void JoinIfSmall(std::size_t chunk);

  OfferView::Chunks chunks_;  // no chunk is empty
  std::size_t size_ = 0;
};

}  // namespace gsv::broker
