#include "gsv/sensing/rays/sphere_grid.h"

#include <algorithm>
#include <cmath>

#include <immintrin.h>

#include "gsv/base/check.h"

#ifdef __AVX__
#error "the versions for processors with and without AVX2 are chosen at run time"
#endif

namespace gsv::sensing {
namespace {

using geometry::Bounds;
using geometry::Vector3;

constexpr double kCellsPerSphere = 3;
constexpr double kMaxCoordinate = 1e5;  // m

// Spheres with more than this many cells in their radius are listed separately.
constexpr double kLargeCells = 2;
constexpr std::size_t kMaxLarge = 32;

// With more spheres than this near the rays, single rays are faster.
constexpr std::size_t kMaxTested = 512, kMaxRows = 128;

// Single precision has a relative error of 6e-8. The gap between ray and centre takes a dozen
// operations on distances from the ray's origin. The coordinates themselves are rounded once.
constexpr double kRounding = 2e-5, kCoordinateRounding = 1e-6;

double SumOfSizes(const Vector3& v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }

bool Suits(const BoundingSphere& sphere) {
  const auto fits = [](double x) { return std::abs(x) <= kMaxCoordinate; };  // false for NaN
  return fits(sphere.centre.x) && fits(sphere.centre.y) && fits(sphere.centre.z) &&
         fits(sphere.radius);
}

// Rays and spheres as structures of arrays.
struct Rays {
  const float *ox, *oy, *oz, *dx, *dy, *dz, *length;
  float rounding;
};
struct Spheres {
  const float *x, *y, *z, *radius;
};

// Spheres that are side by side, in a row of cells.
struct Run {
  std::uint32_t first, count;
};

// Both versions set the masks of the runs' spheres, in this order, to the rays that touch them.
__attribute__((target("avx2"))) void TestByAvx2(const Rays& rays, const Spheres& spheres,
                                                std::span<const Run> runs, unsigned* masks) {
  const __m256 ox = _mm256_load_ps(rays.ox), oy = _mm256_load_ps(rays.oy);
  const __m256 oz = _mm256_load_ps(rays.oz), dx = _mm256_load_ps(rays.dx);
  const __m256 dy = _mm256_load_ps(rays.dy), dz = _mm256_load_ps(rays.dz);
  const __m256 length = _mm256_load_ps(rays.length), zero = _mm256_setzero_ps();
  for (const Run& run : runs) {
    for (std::uint32_t at = run.first; at < run.first + run.count; ++at) {
      const __m256 x = _mm256_set1_ps(spheres.x[at]) - ox, y = _mm256_set1_ps(spheres.y[at]) - oy;
      const __m256 z = _mm256_set1_ps(spheres.z[at]) - oz;
      const __m256 along = _mm256_min_ps(_mm256_max_ps(x * dx + y * dy + z * dz, zero), length);
      const __m256 gap_x = x - along * dx, gap_y = y - along * dy, gap_z = z - along * dz;
      const __m256 gap = gap_x * gap_x + gap_y * gap_y + gap_z * gap_z;
      const float radius = spheres.radius[at] + rays.rounding;
      const __m256 is_near = _mm256_cmp_ps(gap, _mm256_set1_ps(radius * radius), _CMP_LE_OQ);
      *masks++ = static_cast<unsigned>(_mm256_movemask_ps(is_near));
    }
  }
}

unsigned TestBySse(const Rays& rays, const Spheres& spheres, std::uint32_t at) {
  unsigned mask = 0;
  const __m128 cx = _mm_set1_ps(spheres.x[at]), cy = _mm_set1_ps(spheres.y[at]);
  const __m128 cz = _mm_set1_ps(spheres.z[at]);
  const float radius = spheres.radius[at] + rays.rounding;
  for (std::size_t four = 0; four < RayPacket::kMax; four += 4) {
    const __m128 dx = _mm_load_ps(rays.dx + four), dy = _mm_load_ps(rays.dy + four);
    const __m128 dz = _mm_load_ps(rays.dz + four);
    const __m128 x = cx - _mm_load_ps(rays.ox + four), y = cy - _mm_load_ps(rays.oy + four);
    const __m128 z = cz - _mm_load_ps(rays.oz + four);
    const __m128 along = _mm_min_ps(_mm_max_ps(x * dx + y * dy + z * dz, _mm_setzero_ps()),
                                    _mm_load_ps(rays.length + four));
    const __m128 gap_x = x - along * dx, gap_y = y - along * dy, gap_z = z - along * dz;
    const __m128 gap = gap_x * gap_x + gap_y * gap_y + gap_z * gap_z;
    const __m128 is_near = _mm_cmple_ps(gap, _mm_set1_ps(radius * radius));
    mask |= static_cast<unsigned>(_mm_movemask_ps(is_near)) << four;
  }
  return mask;
}

void TestBySse(const Rays& rays, const Spheres& spheres, std::span<const Run> runs,
               unsigned* masks) {
  for (const Run& run : runs) {
    for (std::uint32_t i = 0; i < run.count; ++i) {
      *masks++ = TestBySse(rays, spheres, run.first + i);
    }
  }
}

}  // namespace

PacketSearch::PacketSearch(const RayPacket& rays, const Vector3& place, double reach)
    : place_(place),
      reach_(reach),
      rounding_(static_cast<float>(kRounding * reach +
                                   kCoordinateRounding * (SumOfSizes(place) + reach))),
      used_((1u << rays.count) - 1) {
  for (std::size_t i = 0; i < RayPacket::kMax; ++i) {
    ox_[i] = static_cast<float>(rays.origin_x[i]);
    oy_[i] = static_cast<float>(rays.origin_y[i]);
    oz_[i] = static_cast<float>(rays.origin_z[i]);
    dx_[i] = static_cast<float>(rays.direction_x[i]);
    dy_[i] = static_cast<float>(rays.direction_y[i]);
    dz_[i] = static_cast<float>(rays.direction_z[i]);
    length_[i] = static_cast<float>(rays.max_distance[i]);
  }
}

// Chooses the cells. Returns false if the spheres do not suit a grid.
bool SphereGrid::Divide(std::span<const BoundingSphere> spheres) {
  double high_x = spheres[0].centre.x, high_y = spheres[0].centre.y;
  low_x_ = high_x, low_y_ = high_y;
  bool all_suit = true;
  for (const BoundingSphere& sphere : spheres) {
    all_suit = all_suit && Suits(sphere);
    low_x_ = std::min(low_x_, sphere.centre.x), high_x = std::max(high_x, sphere.centre.x);
    low_y_ = std::min(low_y_, sphere.centre.y), high_y = std::max(high_y, sphere.centre.y);
  }
  if (!all_suit) return false;
  const double wide = high_x - low_x_, tall = high_y - low_y_;
  const double max_cells = kCellsPerSphere * static_cast<double>(spheres.size());
  // The side of a cell, such that there are not many more cells than allowed, even in a thin row.
  const double side =
      std::max({std::sqrt(wide * tall / max_cells), wide / max_cells, tall / max_cells, 1e-3});
  cells_per_metre_ = 1 / side;
  columns_ = static_cast<int>(wide * cells_per_metre_) + 1;
  rows_ = static_cast<int>(tall * cells_per_metre_) + 1;
  return true;
}

void SphereGrid::Build(std::span<const BoundingSphere> spheres, std::span<const Bounds> boxes) {
  GSV_CHECK(spheres.size() == boxes.size());
  large_.clear();
  numbers_.clear();
  is_suitable_ = true;
  if (spheres.empty()) return;
  is_suitable_ = Divide(spheres);
  if (!is_suitable_) return;

  constexpr std::uint32_t kNoCell = ~0u;
  const double too_large = kLargeCells / cells_per_metre_;
  max_radius_ = 0;
  starts_.assign(std::size_t(columns_) * rows_ + 1, 0);
  cell_of_.resize(spheres.size());
  for (std::uint32_t i = 0; i < spheres.size(); ++i) {
    const BoundingSphere& sphere = spheres[i];
    cell_of_[i] = kNoCell;
    // A few spheres share one cell, whatever their size.
    if (sphere.radius > too_large && spheres.size() > kMaxLarge) {
      large_.push_back({boxes[i], i});
      continue;
    }
    max_radius_ = std::max(max_radius_, sphere.radius);
    cell_of_[i] = std::uint32_t(RowOf(sphere.centre.y)) * columns_ + ColumnOf(sphere.centre.x);
    ++starts_[cell_of_[i]];
  }
  is_suitable_ = large_.size() <= kMaxLarge;
  if (!is_suitable_) return;

  // Each count becomes the end of its cell. Inserting the spheres turns it into the start.
  std::uint32_t end = 0;
  for (std::uint32_t& start : starts_) start = end += start;
  for (std::vector<float>* each : {&x_, &y_, &z_, &radius_}) each->resize(end);
  numbers_.resize(end);
  for (auto i = static_cast<std::uint32_t>(spheres.size()); i-- > 0;) {
    if (cell_of_[i] == kNoCell) continue;
    const BoundingSphere& sphere = spheres[i];
    const std::uint32_t at = --starts_[cell_of_[i]];
    x_[at] = static_cast<float>(sphere.centre.x);
    y_[at] = static_cast<float>(sphere.centre.y);
    z_[at] = static_cast<float>(sphere.centre.z);
    radius_[at] = static_cast<float>(sphere.radius + kRounding * sphere.radius +
                                     kCoordinateRounding * SumOfSizes(sphere.centre));
    numbers_[at] = i;
  }
}

bool SphereGrid::AddLarge(const PacketSearch& search, TouchedSpheres& found) const {
  const Vector3& place = search.place_;
  for (const Large& large : large_) {
    const auto is_near = [&](double low, double x, double high) {
      return low - x <= search.reach_ && x - high <= search.reach_;
    };
    if (!is_near(large.box.min.x, place.x, large.box.max.x) ||
        !is_near(large.box.min.y, place.y, large.box.max.y) ||
        !is_near(large.box.min.z, place.z, large.box.max.z)) {
      continue;
    }
    if (found.count == TouchedSpheres::kMax) return false;
    found.touched[found.count++] = {large.number, search.used_};
  }
  return true;
}

bool SphereGrid::FindTouched(const PacketSearch& search, TouchedSpheres& found) const {
  if (!is_suitable_) return false;
  if (!AddLarge(search, found)) return false;
  if (numbers_.empty()) return true;
  static const bool has_avx2 = __builtin_cpu_supports("avx2");
  const Rays rays{search.ox_.data(), search.oy_.data(), search.oz_.data(),     search.dx_.data(),
                  search.dy_.data(), search.dz_.data(), search.length_.data(), search.rounding_};
  const Spheres spheres{x_.data(), y_.data(), z_.data(), radius_.data()};
  const double reach = search.reach_ + max_radius_ + search.rounding_;
  const Vector3& place = search.place_;
  const int left = ColumnOf(place.x - reach), right = ColumnOf(place.x + reach);
  const int front = RowOf(place.y - reach), back = RowOf(place.y + reach);
  std::array<Run, kMaxRows> runs;
  std::size_t run_count = 0, tested = 0;
  if (back - front >= static_cast<int>(kMaxRows)) return false;
  for (int row = front; row <= back; ++row) {
    const std::uint32_t* const starts = &starts_[std::size_t(row) * columns_];
    runs[run_count] = {starts[left], starts[right + 1] - starts[left]};
    tested += runs[run_count].count;
    run_count += runs[run_count].count > 0;
  }
  if (tested > kMaxTested) return false;
  const auto in_reach = std::span<const Run>(runs).first(run_count);
  std::array<unsigned, kMaxTested> masks;
  has_avx2 ? TestByAvx2(rays, spheres, in_reach, masks.data())
           : TestBySse(rays, spheres, in_reach, masks.data());
  const unsigned* mask = masks.data();
  for (const Run& run : in_reach) {
    for (std::uint32_t at = run.first; at < run.first + run.count; ++at) {
      if (found.count == TouchedSpheres::kMax) return false;
      // Which spheres are touched is hard to predict, so they are written without a branch.
      const unsigned touching = *mask++ & search.used_;
      found.touched[found.count] = {numbers_[at], touching};
      found.count += touching != 0;
    }
  }
  return true;
}

}  // namespace gsv::sensing
