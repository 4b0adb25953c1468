// The offers of one service type in the order of export. A query makes a view and reads it without a
// lock, while another thread changes the offers. The offers are stored in chunks, each with one
// column for each property. A change of an offer copies the offer's chunk if a view reads it.
//
// Threads  any thread may read a view. One thread at a time may change the column. Several threads
//          may make views while no thread changes it.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "gsv/broker/language/offer.h"
#include "gsv/broker/offers/column_constraint.h"
#include "gsv/broker/offers/property_column.h"

namespace gsv::broker {

// A part of the offers, with their property columns.
class OfferChunk {
 public:
  explicit OfferChunk(Offers offers) : offers_(std::move(offers)) {}

  const Offers& offers() const { return offers_; }
  // Returns the column of a property, or null if it does not exist (yet).
  std::shared_ptr<const PropertyColumn> ColumnOf(const std::string& property) const;
  // Returns for each offer whether it matches, as far as the columns determine it.
  std::vector<Choice> Choose(const ColumnConstraint& constraint) const;
  // Whether none of the offers is a proxy or has a dynamic property.
  bool IsPlain() const { return columns_.ArePlain(offers_); }

 private:
  friend class OfferColumn;
  friend class OfferView;

  Offers offers_;
  mutable PropertyColumns columns_;
  std::atomic<int> readers_ = 0;
};

// The content of an OfferColumn at the time at which the view was made.
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
  // Returns a view of the present offers.
  OfferView View() const { return OfferView(chunks_); }

  // Returns the offer with this number, or null if there is none.
  OfferPtr Find(std::uint64_t number) const;
  // Returns all offers.
  Offers All() const;

  // Adds the offer, or replaces the offer that has the same number.
  void Put(OfferPtr offer);
  // Removes an offer, which must exist.
  void Remove(std::uint64_t number);

 private:
  using Place = std::pair<std::size_t, std::size_t>;  // a chunk, and an index in the chunk

  // The place of the first offer whose number is at least `number`, in the chunk to which `number`
  // belongs. A number above the numbers of all offers belongs to the last chunk.
  Place PlaceOf(std::uint64_t number) const;
  // Returns the chunk's offers, which the caller may change.
  Offers& Own(std::size_t chunk);
  // Splits a chunk with more than kChunk offers in two.
  void SplitIfFull(std::size_t chunk);
  // Removes the chunk if it is empty. If it has at most kChunk / 4 offers, moves them to the chunk
  // before it, but only if that chunk then has at most kChunk / 2 offers.
  void JoinIfSmall(std::size_t chunk);

  OfferView::Chunks chunks_;  // chunks are never empty
  std::size_t size_ = 0;
};

}  // namespace gsv::broker
