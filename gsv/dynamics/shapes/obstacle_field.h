// The obstacles in one slice of the world, in a grid for queries by position.
//
// The grid is uniform. Each cell lists the obstacles within `margin` of it, so that a query with a
// reach up to `margin` needs only one cell.
//
// Units    metres, world frame.
// Threads  const members may run concurrently.
#pragma once

#include <cstdint>
#include <vector>

#include "gsv/dynamics/shapes/convex_piece.h"
#include "gsv/model/collision_filter.h"

namespace gsv::dynamics {

// A piece of a sliced body: an area of the plane, in the world's frame.
struct Obstacle {
  ConvexPiece shape;
  Vector2 centre;  // centre and radius of a disc around the shape, m
  double radius = 0;
  int body = 0;                     // index of the body in the layout
  model::CollisionFilter filter{};  // the bodies with which the piece collides
};

// A grid that finds the obstacles near a position. See the top of this file for `margin` (m).
class ObstacleField {
 public:
  ObstacleField() = default;
  // `margin` (m): a query within this distance needs only one cell.
  ObstacleField(std::vector<Obstacle> obstacles, double margin);

  const Obstacle& operator[](std::uint32_t index) const { return obstacles_[index]; }
  std::size_t size() const { return obstacles_.size(); }

  // Calls `visit` with the index of every obstacle whose disc is within `reach` of the point. The
  // order depends only on the point's cell. If `reach` exceeds the margin, an obstacle may be
  // visited twice.
  template <typename Visit>
  void ForEachNear(Vector2 point, double reach, Visit visit) const {
    for (const std::uint32_t index : everywhere_) VisitIfNear(index, point, reach, visit);
    if (entries_.empty()) return;
    const double beyond = reach > margin_ ? reach - margin_ : 0;
    const int first_column = Clamped((point.x - beyond - left_) * per_cell_, columns_);
    const int last_column = Clamped((point.x + beyond - left_) * per_cell_, columns_);
    const int first_row = Clamped((point.y - beyond - bottom_) * per_cell_, rows_);
    const int last_row = Clamped((point.y + beyond - bottom_) * per_cell_, rows_);
    for (int row = first_row; row <= last_row; ++row) {
      for (int column = first_column; column <= last_column; ++column) {
        const std::size_t cell = std::size_t(row) * columns_ + column;
        for (std::uint32_t k = cell_start_[cell]; k < cell_start_[cell + 1]; ++k) {
          VisitIfNear(entries_[k], point, reach, visit);
        }
      }
    }
  }

 private:
  // Chooses the extent of the grid and the size of its cells.
  void LayOutGrid();
  // Adds each obstacle to the cells near it.
  void FillGrid();
  template <typename Visit>
  void ForEachCellNear(const Obstacle& obstacle, Visit visit) const;

  // Returns the index of the cell for a coordinate in units of cells. Coordinates outside the grid
  // belong to the cells at its edge.
  static int Clamped(double coordinate, int count) {
    return coordinate < 1 ? 0 : coordinate >= count ? count - 1 : static_cast<int>(coordinate);
  }

  template <typename Visit>
  void VisitIfNear(std::uint32_t index, Vector2 point, double reach, Visit& visit) const {
    const Obstacle& obstacle = obstacles_[index];
    const Vector2 d = obstacle.centre - point;
    const double within = reach + obstacle.radius;
    if (Dot(d, d) <= within * within) visit(index);
  }

  std::vector<Obstacle> obstacles_;
  std::vector<std::uint32_t> everywhere_;        // obstacles that are too large for the grid
  double margin_ = 0;                            // see the top of this file, m
  double left_ = 0, bottom_ = 0, per_cell_ = 1;  // minimum x and y, m; number of cells per metre
  int columns_ = 0, rows_ = 0;                   // size of the grid in cells
  std::vector<std::uint32_t> cell_start_;  // start of each cell's entries in entries_, and the end
  std::vector<std::uint32_t> entries_;     // indices of obstacles, cell by cell
};

}  // namespace gsv::dynamics
