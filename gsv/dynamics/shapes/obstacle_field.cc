#include "gsv/dynamics/shapes/obstacle_field.h"

#include <algorithm>
#include <utility>

#include "gsv/geometry/constants.h"

namespace gsv::dynamics {
namespace {

constexpr double kMinCell = 0.25;
constexpr double kTooLarge = 500;  // larger obstacles (radius in m) are not in the grid; every
                                   // query checks them
constexpr double kMaxCells = 1 << 20;
constexpr double kMaxEntries = 1 << 23;

using geometry::kInfinity;

struct Range {
  double low = kInfinity, high = -kInfinity;

  void Add(double x) {
    low = std::min(low, x);
    high = std::max(high, x);
  }
};

// Returns the extent along x of the part of the piece's hull that lies within a band of y.
Range ReachIn(const ConvexPiece& piece, const Range& band) {
  Range reach;
  for (int k = 0; k < piece.vertex_count; ++k) {
    const Vector2 from = piece.vertices[k];
    const Vector2 to = piece.vertices[k + 1 == piece.vertex_count ? 0 : k + 1];
    if (from.y >= band.low && from.y <= band.high) reach.Add(from.x);
    for (const double y : {band.low, band.high}) {
      if ((from.y < y) == (to.y < y)) continue;
      reach.Add(from.x + (y - from.y) / (to.y - from.y) * (to.x - from.x));
    }
  }
  return reach;
}

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
  double right = -kInfinity, top = -kInfinity;
  left_ = bottom_ = kInfinity;
  for (const Obstacle& o : obstacles_) {
    if (o.radius > kTooLarge) continue;
    left_ = std::min(left_, o.centre.x - o.radius - margin_);
    bottom_ = std::min(bottom_, o.centre.y - o.radius - margin_);
    right = std::max(right, o.centre.x + o.radius + margin_);
    top = std::max(top, o.centre.y + o.radius + margin_);
  }
  // The outermost cells stay empty. They represent everything outside the grid.
  double size = std::max(kMinCell, margin_);
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
  } while (cells > kMaxCells || (entries > kMaxEntries && cells > 1024));
  left_ -= size;
  bottom_ -= size;
  columns_ = static_cast<int>((right - left_) / size) + 2;
  rows_ = static_cast<int>((top - bottom_) / size) + 2;
}

// Calls `visit` with each cell that is within the margin of the
// obstacle.
template <typename Visit>
void ObstacleField::ForEachCellNear(const Obstacle& obstacle, Visit visit) const {
  const ConvexPiece& shape = obstacle.shape;
  const double size = 1 / per_cell_;
  const double half_diagonal = size * 0.70710678118654757 * (1 + 1e-9);
  const double within = half_diagonal + margin_, from_hull = within + shape.radius;
  const double reach = obstacle.radius + margin_;
  const int first_row = Clamped((obstacle.centre.y - reach - bottom_) * per_cell_, rows_);
  const int last_row = Clamped((obstacle.centre.y + reach - bottom_) * per_cell_, rows_);
  for (int row = first_row; row <= last_row; ++row) {
    const double y = bottom_ + (row + 0.5) * size;
    const Range hull = ReachIn(shape, {y - from_hull, y + from_hull});
    if (hull.low > hull.high) continue;
    const int first_column = Clamped((hull.low - from_hull - left_) * per_cell_, columns_);
    const int last_column = Clamped((hull.high + from_hull - left_) * per_cell_, columns_);
    for (int column = first_column; column <= last_column; ++column) {
      if (DistanceTo(shape, {left_ + (column + 0.5) * size, y}) > within) continue;
      visit(std::uint32_t(row) * columns_ + column);
    }
  }
}

void ObstacleField::FillGrid() {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> found;  // pairs of (cell, obstacle)
  for (std::uint32_t i = 0; i < obstacles_.size(); ++i) {
    if (obstacles_[i].radius > kTooLarge) continue;
    ForEachCellNear(obstacles_[i], [&](std::uint32_t cell) { found.emplace_back(cell, i); });
  }
  cell_start_.assign(std::size_t(columns_) * rows_ + 1, 0);
  for (const auto& [cell, obstacle] : found) ++cell_start_[cell + 1];
  for (std::size_t c = 1; c < cell_start_.size(); ++c) cell_start_[c] += cell_start_[c - 1];
  std::vector<std::uint32_t> next(cell_start_.begin(), cell_start_.end() - 1);
  entries_.resize(found.size());
  for (const auto& [cell, obstacle] : found) entries_[next[cell]++] = obstacle;
}

}  // namespace gsv::dynamics
