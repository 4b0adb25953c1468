// A uniform grid of columns over the ground, which finds the boxes near a ray.
//
// The grid is fast if boxes are side by side, like robots and obstacles; see occupancy().
//
// Exactness    a box is listed in every column within kMargin. So the box is found even if rounding
//              moves the ray into the adjacent column (for coordinates up to kMaxCoordinate).
// Threads      const members may run concurrently.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "gsv/geometry/triangle_mesh.h"
#include "gsv/sensing/rays/ray_axis.h"
#include "gsv/sensing/rays/ray_scene.h"

namespace gsv::sensing {

// The numbers of the boxes near a place.
struct FoundBoxes {
  static constexpr std::size_t kMax = 256;
  std::array<std::uint32_t, kMax> boxes;  // indices of boxes; only the first `count` are valid
  std::size_t count = 0;
};

// Finds the boxes that a ray passes through, by a grid over the ground.
class ColumnGrid {
 public:
  static constexpr double kMargin = 1e-6;        // m
  static constexpr double kMaxCoordinate = 1e5;  // m

  // Replaces all boxes. They must lie within ±kMaxCoordinate in x and y.
  void Build(std::span<const geometry::Bounds> boxes);

  // The mean number of boxes in a column. A column is weighted with its number of boxes, so empty
  // columns do not count.
  double occupancy() const { return occupancy_; }

  // Calls visit(box) for every box that the ray may pass through within `length` (m). A box may be
  // visited more than once. `length` is read again after each column, so `visit` may reduce it, for
  // example to the distance of a hit.
  template <class Visit>
  void Walk(const Ray& ray, const double& length, const Visit& visit) const {
    const RayAxis x(ray.origin.x, ray.direction.x), y(ray.origin.y, ray.direction.y);
    double begin = 0, end = 1000 * kMaxCoordinate;
    x.Clip(low_x_, low_x_ + columns_ * cell_, begin, end);
    y.Clip(low_y_, low_y_ + rows_ * cell_, begin, end);
    if (!(begin <= std::min(end, length))) return;
    // The grid has a ring of empty columns around it, for rays that rounding moves over the grid's
    // edge.
    const int column = IndexOf(x.At(begin) - low_x_), row = IndexOf(y.At(begin) - low_y_);
    double next_x = x.Reaches(low_x_ + (column - x.is_falling) * cell_);
    double next_y = y.Reaches(low_y_ + (row - y.is_falling) * cell_);
    const double step_x = cell_ * std::abs(x.inverse), step_y = cell_ * std::abs(y.inverse);
    const std::ptrdiff_t stride = columns_ + 2;
    const std::ptrdiff_t across = x.is_falling ? -1 : 1, along = y.is_falling ? -stride : stride;
    for (const std::uint32_t* at = &starts_[row * stride + column];;) {
      for (std::uint32_t i = at[0]; i < at[1]; ++i) visit(entries_[i] & kBox);
      const double next = std::min(next_x, next_y);
      if (next > std::min(end, length)) return;
      const bool is_across = next_x < next_y;
      at += is_across ? across : along;
      next_x += is_across ? step_x : 0;
      next_y += is_across ? 0 : step_y;
    }
  }

  // Adds to `found` every box within `reach` of the place, once, and possibly boxes further away.
  // If there is no space, returns false, and some boxes are missing.
  bool Near(const geometry::Vector3& place, double reach, FoundBoxes& found) const;

 private:
  // An entry contains a box's number, and whether the column is the box's first column or first
  // row.
  static constexpr std::uint32_t kFirstColumn = 1u << 31, kFirstRow = 1u << 30;
  static constexpr std::uint32_t kBox = kFirstRow - 1;

  // The columns and rows of the grid that a box covers, all four included.
  struct Range {
    std::uint16_t first_column, last_column, first_row, last_row;
  };

  // Returns the index of the column (row) of a coordinate, counted from the ring.
  int IndexOf(double from_low) const { return static_cast<int>(from_low * per_metre_ + 1); }
  // Divides an area of `width` by `depth` metres into columns with sides of `cell` metres.
  void Divide(double cell, double width, double depth);
  // Counts the boxes of each column. Returns false if the total exceeds `limit`.
  bool Count(std::span<const geometry::Bounds> boxes, std::size_t limit);

  double low_x_ = 0, low_y_ = 0;             // smallest coordinates of the grid without the ring, m
  double cell_ = 1, per_metre_ = 1;          // width and depth of a column, m; and 1 / cell_
  int columns_ = 0, rows_ = 0;               // number of columns and rows without the ring
  double occupancy_ = 0;                     // see occupancy()
  std::vector<Range> ranges_;                // columns and rows of each box
  std::vector<std::uint32_t> starts_{0, 0};  // the start of each column in `entries_`, and the end
  std::vector<std::uint32_t> entries_;       // entries of all columns, one column after the other
};

}  // namespace gsv::sensing
