// The offers that a query found, in order. The list has plain pointers to the offers and keeps the
// views alive that contain them. With a shared pointer for each offer, a query would have to write
// the reference count of each found offer.
//
// Threads  not safe. The memory of KeptOffers may be released by any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <span>
#include <vector>

#include "gsv/broker/offers/offer_column.h"

namespace gsv::broker {

// Keeps found offers alive. Several lists may share one KeptOffers.
struct KeptOffers {
  std::vector<OfferView> views{};
  std::deque<OfferPtr> others{};  // offers that are in no view; their addresses never change
};

// The list of found offers. Its elements point to offers in `views` or `others` of KeptOffers.
class FoundOffers {
 public:
  class Iterator {
   public:
    explicit Iterator(const OfferPtr* const* place) : place_(place) {}
    const OfferPtr& operator*() const { return **place_; }
    Iterator& operator++() {
      ++place_;
      return *this;
    }
    bool operator==(const Iterator& other) const { return place_ == other.place_; }

   private:
    const OfferPtr* const* place_;
  };

  // Makes an empty list. `views` must contain the offers that Add() will add.
  explicit FoundOffers(std::vector<OfferView> views = {});

  std::size_t size() const { return places_.size(); }
  bool empty() const { return places_.empty(); }
  const OfferPtr& operator[](std::size_t index) const { return *places_[index]; }
  const OfferPtr& front() const { return *places_.front(); }
  const OfferPtr& back() const { return *places_.back(); }
  Iterator begin() const { return Iterator(places_.data()); }
  Iterator end() const { return Iterator(places_.data() + places_.size()); }

  const std::vector<OfferView>& views() const { return kept_->views; }
  // Pointers to the found offers, valid as long as kept().
  const std::vector<const OfferPtr*>& places() const { return places_; }
  std::shared_ptr<const KeptOffers> kept() const { return kept_; }

  // `offer` is an element of one of the views.
  void Add(const OfferPtr& offer) { places_.push_back(&offer); }
  // Adds the offers of `chunk` that have these indices. The chunk belongs to one of the views.
  void Add(const Offers& chunk, std::span<const std::uint32_t> indices);
  // Adds an offer that is in none of the views.
  void AddOther(OfferPtr offer);
  // Replaces places(). kept() must contain the offers.
  void SetPlaces(std::vector<const OfferPtr*> places) { places_ = std::move(places); }
  // Removes the offers after the first `size`.
  void Truncate(std::size_t size);
  // If the offers of this list are only a small part of the views' offers, copies the shared
  // pointers to them and gives up the views, so that other offers can be freed. Then pointers that
  // places() returned before are invalid.
  void ReleaseViews();

 private:
  std::shared_ptr<KeptOffers> kept_;     // keeps the found offers alive
  std::vector<const OfferPtr*> places_;  // pointers to the found offers, in the order of the list
};

}  // namespace gsv::broker
