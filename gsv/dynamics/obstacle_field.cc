#include "gsv/dynamics/obstacle_field.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace gsv::dynamics {
namespace {

constexpr double kSmallestCell = 0.25;
constexpr double kTooLarge = 500;  // m in radius; such obstacles are looked at by all
constexpr double kMostCells = 1 << 20;
constexpr double kMostEntries = 1 << 23;

}  // namespace

ObstacleField::ObstacleField(std::vector<Obstacle> obstacles, double margin)
    : obstacles_(std::move(obstacles)), margin_(margin) {
  for (std::uint32_t i = 0; i < obstacles_.size(); ++i) {
    if (obstacles_[i].radius > kTooLarge) everywhere_.push_back(i);
  }
  if (everywhere_.size() == obstacles_.size()) return;
  LayOutGrid();
  FillGrid();
}

void ObstacleField::LayOutGrid() {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double right = -kInfinity, top = -kInfinity;
  left_ = bottom_ = kInfinity;
  for (const Obstacle& o : obstacles_) {
    if (o.radius > kTooLarge) continue;
    left_ = std::min(left_, o.centre.x - o.radius - margin_);
    bottom_ = std::min(bottom_, o.centre.y - o.radius - margin_);
    right = std::max(right, o.centre.x + o.radius + margin_);
    top = std::max(top, o.centre.y + o.radius + margin_);
  }
  // The outermost cells stay empty: they stand for all that lies beyond.
  double size = std::max(kSmallestCell, margin_);
  double entries = 0, cells = 0;
  do {
    if (cells > 0) size *= 2;
    per_cell_ = 1 / size;
    cells = ((right - left_) / size + 3) * ((top - bottom_) / size + 3);
    entries = 0;
    for (const Obstacle& o : obstacles_) {
      const double across = 2 * (std::min(o.radius, kTooLarge) + margin_) / size + 2;
      entries += across * across;
    }
  } while (cells > kMostCells || (entries > kMostEntries && cells > 1024));
  left_ -= size;
  bottom_ -= size;
  columns_ = static_cast<int>((right - left_) / size) + 2;
  rows_ = static_cast<int>((top - bottom_) / size) + 2;
}

ObstacleField::Cells ObstacleField::CellsNear(const Obstacle& obstacle) const {
  const double reach = obstacle.radius + margin_;
  return {Clamped((obstacle.centre.x - reach - left_) * per_cell_, columns_),
          Clamped((obstacle.centre.x + reach - left_) * per_cell_, columns_),
          Clamped((obstacle.centre.y - reach - bottom_) * per_cell_, rows_),
          Clamped((obstacle.centre.y + reach - bottom_) * per_cell_, rows_)};
}

void ObstacleField::FillGrid() {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> found;  // (cell, obstacle)
  const double size = 1 / per_cell_;
  const double half_diagonal = size * 0.70710678118654757 * (1 + 1e-9);
  for (std::uint32_t i = 0; i < obstacles_.size(); ++i) {
    if (obstacles_[i].radius > kTooLarge) continue;
    const Cells cells = CellsNear(obstacles_[i]);
    for (int row = cells.first_row; row <= cells.last_row; ++row) {
      for (int column = cells.first_column; column <= cells.last_column; ++column) {
        const ConvexPiece middle =
            Disc({left_ + (column + 0.5) * size, bottom_ + (row + 0.5) * size}, half_diagonal);
        if (Separate(middle, obstacles_[i].shape).distance > margin_) continue;
        found.emplace_back(std::uint32_t(row) * columns_ + column, i);
      }
    }
  }
  cell_start_.assign(std::size_t(columns_) * rows_ + 1, 0);
  for (const auto& [cell, obstacle] : found) ++cell_start_[cell + 1];
  for (std::size_t c = 1; c < cell_start_.size(); ++c) cell_start_[c] += cell_start_[c - 1];
  std::vector<std::uint32_t> next(cell_start_.begin(), cell_start_.end() - 1);
  entries_.resize(found.size());
  for (const auto& [cell, obstacle] : found) entries_[next[cell]++] = obstacle;
}

}  // namespace gsv::dynamics
