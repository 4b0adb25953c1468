// A uniform grid of bounding spheres over the ground, for packets of rays. It finds the spheres
// that the rays of a packet may hit. Spheres of one cell, and of the cells beside it, are adjacent
// in memory.
//
// Exactness  spheres are tested in single precision. They are enlarged by more than the error of
//            single precision, so that no sphere on a ray is omitted.
// Threads    const members may run concurrently.
// Units      metres, world frame (or the frame of a set).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "gsv/geometry/triangle_mesh.h"
#include "gsv/sensing/rays/candidate_set.h"
#include "gsv/sensing/rays/ray_packet.h"

namespace gsv::sensing {

// Spheres by number, and the rays of a packet that may touch them: bit i stands for ray i.
struct TouchedSpheres {
  static constexpr std::size_t kMax = 64;
  struct Touched {
    std::uint32_t number;  // number of the sphere in its grid
    unsigned rays;         // bit i: ray i may touch the sphere
  };
  std::array<Touched, kMax> touched;  // the first `count` are valid
  std::size_t count = 0;

  std::span<const Touched> all() const { return std::span(touched).first(count); }
};

// Rays of a packet in single precision, as a structure of arrays. Positions are relative to a point
// near the rays (place_x, place_y, place_z).
struct PacketRays {
  using Floats = std::array<float, RayPacket::kMax>;

  alignas(32) Floats dx, dy, dz;    // directions of the rays
  alignas(32) Floats ox, oy, oz;    // origins of the rays relative to the place, times -2
  alignas(32) Floats start;         // scalar product of origin and direction
  alignas(32) Floats square;        // square of the origin's distance, m²
  alignas(32) Floats length;        // lengths of the rays, m
  float place_x, place_y, place_z;  // in the world, m
  float reach;                      // largest distance from the place to a point of a ray, m
  float rounding;                   // distance by which spheres are enlarged, m
  unsigned used;                    // bit i: whether ray i exists
};

// The rays of a packet near one place, prepared for searches in several grids.
class PacketSearch {
 public:
  // `reach` is the largest distance from `place` to a point of a ray.
  PacketSearch(const RayPacket& packet, const geometry::Vector3& place, double reach);

 private:
  friend class SphereGrid;

  geometry::Vector3 place_;  // in the world, m
  double reach_;             // see the constructor, m
  PacketRays rays_;          // the packet in single precision
};

// Finds the spheres that the rays of a packet may touch.
class SphereGrid {
 public:
  // Replaces all spheres. Sphere i bounds the same solid as boxes[i]. If `boxes` is empty, the
  // bounding boxes of the spheres are used.
  void Build(std::span<const BoundingSphere> spheres, std::span<const geometry::Bounds> boxes);

  // Appends the spheres that at least one ray may touch. Returns false, and may omit spheres, if
  // there are too many near the place or if the grid does not suit the spheres.
  bool FindTouched(const PacketSearch& search, TouchedSpheres& found) const;

 private:
  // A solid that is too large for a cell.
  struct Large {
    geometry::Bounds box;  // bounding box of the solid
    std::uint32_t number;  // as in Build()
  };

  // The column of an x coordinate. Returns the nearest column if x is outside of the grid.
  int ColumnOf(double x) const { return CellOf((x - low_x_) * cells_per_metre_, columns_); }
  // The row of a y coordinate. Returns the nearest row if y is outside of the grid.
  int RowOf(double y) const { return CellOf((y - low_y_) * cells_per_metre_, rows_); }
  static int CellOf(double cells, int count) {
    return static_cast<int>(std::clamp(cells, 0.0, count - 1.0));
  }
  // Adds the large spheres near the packet. Returns false if there is no space.
  bool AddLarge(const PacketSearch& search, TouchedSpheres& found) const;
  // Chooses the cells. Returns false if the spheres do not suit a grid.
  bool Divide(std::span<const BoundingSphere> spheres);

  bool is_suitable_ = true;                             // whether the spheres suit a grid
  double low_x_ = 0, low_y_ = 0, cells_per_metre_ = 0;  // corner of the grid, m; 1 / side of a cell
  int columns_ = 0, rows_ = 0;
  double max_radius_ = 0;  // the radius of the largest sphere that is in a cell
  // The index of the first sphere of each cell, row by row. The last element is the number of
  // spheres.
  std::vector<std::uint32_t> starts_;
  std::vector<std::uint32_t> cell_of_;  // working memory of Build()
  std::uint32_t count_ = 0;             // the number of spheres in cells
  // The spheres, ordered by cell. After the last sphere there is space for a whole vector.
  std::vector<float> x_, y_, z_, radius_;
  std::vector<std::uint32_t> numbers_;  // the number of each sphere, as in Build()
  std::vector<Large> large_;            // solids that are too large for cells
};

}  // namespace gsv::sensing
