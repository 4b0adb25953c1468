// Broad phase of discs: finds the pairs that may touch, with a uniform grid that each call
// rebuilds.
//
// Determinism  the pairs and their order depend on the discs alone.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gsv/geometry/vector3.h"

namespace gsv::dynamics {

// Finds the pairs of overlapping discs.
class BroadPhase {
 public:
  // The indices of two discs.
  struct Pair {
    std::uint32_t first, second;  // first < second
    // NOLINTNEXTLINE(modernize-use-nullptr)
    friend auto operator<=>(const Pair&, const Pair&) = default;
  };

  // All pairs of discs that overlap, once each, in ascending order. The spans must have equal
  // lengths. The result is valid until the next call. Allocates only while the number of discs or
  // pairs grows.
  const std::vector<Pair>& Find(std::span<const geometry::Vector2> centres,
                                std::span<const double> radii);

 private:
  // A disc in a cell of the grid.
  struct Entry {
    double x, y, radius;  // centre and radius of the disc, m
    std::uint32_t index;  // index of the disc in the arguments of Find()
  };

  // Sorts the discs into the cells of the grid.
  void Sort(std::span<const geometry::Vector2> centres, std::span<const double> radii);
  // Adds the pairs of overlapping discs within one range of entries, or between two ranges.
  void PairWithin(std::uint32_t begin, std::uint32_t end);
  void PairAcross(std::uint32_t begin, std::uint32_t end, std::uint32_t other_begin,
                  std::uint32_t other_end);
  // Adds the pair if the two discs overlap.
  void AddIfNear(const Entry& a, const Entry& b);

  int columns_ = 0, rows_ = 0;  // size of the grid in cells
  // The cell of each disc. For each cell, the start of its entries in entries_.
  std::vector<std::uint32_t> cell_of_, cell_start_;
  std::vector<Entry> entries_;  // sorted by cell
  std::vector<Pair> pairs_;
};

}  // namespace gsv::dynamics
