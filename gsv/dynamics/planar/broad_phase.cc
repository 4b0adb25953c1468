#include "gsv/dynamics/planar/broad_phase.h"

#include <algorithm>
#include <cmath>

#include "gsv/base/check.h"

namespace gsv::dynamics {

using geometry::Vector2;

// Cells are as wide as the widest disc, or wider if there would be many more cells than discs. So
// two discs that overlap are in the same cell or in adjacent cells.
void BroadPhase::Sort(std::span<const Vector2> centres, std::span<const double> radii) {
  Vector2 low = centres[0], high = centres[0];
  double widest = 1e-3;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    low = {std::min(low.x, centres[i].x), std::min(low.y, centres[i].y)};
    high = {std::max(high.x, centres[i].x), std::max(high.y, centres[i].y)};
    widest = std::max(widest, 2 * radii[i]);
  }
  const double most_cells = 4.0 * static_cast<double>(centres.size()) + 64;
  const double wide = high.x - low.x, tall = high.y - low.y;
  while ((wide / widest + 1) * (tall / widest + 1) > most_cells) widest *= 1.5;
  const double per_cell = (1 - 1e-9) / widest;
  columns_ = static_cast<int>(wide * per_cell) + 1;
  rows_ = static_cast<int>(tall * per_cell) + 1;

  cell_start_.assign(std::size_t(columns_) * rows_ + 1, 0);
  cell_of_.resize(centres.size());
  entries_.resize(centres.size());
  for (std::size_t i = 0; i < centres.size(); ++i) {
    const int column = static_cast<int>((centres[i].x - low.x) * per_cell);
    const int row = static_cast<int>((centres[i].y - low.y) * per_cell);
    cell_of_[i] = std::uint32_t(row) * columns_ + column;
    ++cell_start_[cell_of_[i]];
  }
  for (std::size_t c = 1; c < cell_start_.size(); ++c) cell_start_[c] += cell_start_[c - 1];
  // Fills the entries of each cell from last to first. Then cell_start_ is the first entry of each
  // cell.
  for (std::size_t i = centres.size(); i-- > 0;) {
    const std::uint32_t at = --cell_start_[cell_of_[i]];
    entries_[at] = {centres[i].x, centres[i].y, radii[i], static_cast<std::uint32_t>(i)};
  }
}

void BroadPhase::AddIfNear(const Entry& a, const Entry& b) {
  const double dx = a.x - b.x, dy = a.y - b.y, reach = a.radius + b.radius;
  if (dx * dx + dy * dy > reach * reach) return;
  pairs_.push_back({std::min(a.index, b.index), std::max(a.index, b.index)});
}

void BroadPhase::PairWithin(std::uint32_t begin, std::uint32_t end) {
  for (std::uint32_t i = begin; i < end; ++i) {
    for (std::uint32_t k = i + 1; k < end; ++k) AddIfNear(entries_[i], entries_[k]);
  }
}

void BroadPhase::PairAcross(std::uint32_t begin, std::uint32_t end, std::uint32_t other_begin,
                            std::uint32_t other_end) {
  for (std::uint32_t i = begin; i < end; ++i) {
    for (std::uint32_t k = other_begin; k < other_end; ++k) AddIfNear(entries_[i], entries_[k]);
  }
}

const std::vector<BroadPhase::Pair>& BroadPhase::Find(std::span<const Vector2> centres,
                                                      std::span<const double> radii) {
  GSV_CHECK(centres.size() == radii.size());
  pairs_.clear();
  if (centres.size() < 2) return pairs_;
  Sort(centres, radii);
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      const std::size_t cell = std::size_t(row) * columns_ + column;
      const std::uint32_t begin = cell_start_[cell], end = cell_start_[cell + 1];
      if (begin == end) continue;
      PairWithin(begin, end);
      // Compares with the cell to the right and the three cells above; the cells to the left and
      // below compare with this cell. Cells of one row are adjacent in entries_.
      if (column + 1 < columns_) PairAcross(begin, end, end, cell_start_[cell + 2]);
      if (row + 1 < rows_) {
        const std::size_t above = cell + columns_;
        PairAcross(begin, end, cell_start_[above - (column > 0 ? 1 : 0)],
                   cell_start_[above + (column + 1 < columns_ ? 1 : 0) + 1]);
      }
    }
  }
  std::sort(pairs_.begin(), pairs_.end());
  return pairs_;
}

}  // namespace gsv::dynamics
