#include "gsv/sensing/rays/sphere_grid.h"

#include <algorithm>
#include <bit>
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

constexpr double kCellsPerSphere = 1;
constexpr double kMaxCoordinate = 1e5;  // m

// Spheres with more than this many cells in their radius are listed separately.
constexpr double kLargeCells = 2;
constexpr std::size_t kMaxLarge = 32;

// With more spheres than this near the rays, single rays are faster.
constexpr std::size_t kMaxTested = 512, kMaxRows = 128;

// Spheres are read in vectors of this length.
constexpr std::size_t kRead = 8;

// Single precision has a relative error of 6e-8. Spheres are enlarged by these fractions of the
// reach and of the coordinates, which are rounded once.
constexpr double kRounding = 2e-5, kCoordinateRounding = 1e-6;

double SumOfSizes(const Vector3& v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }

bool Suits(const BoundingSphere& sphere) {
  const auto fits = [](double x) { return std::abs(x) <= kMaxCoordinate; };  // false for NaN
  return fits(sphere.centre.x) && fits(sphere.centre.y) && fits(sphere.centre.z) &&
         fits(sphere.radius);
}

// Spheres are enlarged by this fraction of the squared distances in their test. It exceeds the
// rounding error of the squared gap between centre and ray, which takes a dozen operations in
// single precision.
constexpr float kSquareRounding = 1e-6f;

// Spheres that are side by side, in a row of cells.
struct Run {
  std::uint32_t first, end;
};

// The spheres of a grid, and the runs of those in reach. The arrays may be read beyond the last
// sphere, in whole vectors of eight.
struct NearSpheres {
  const float *x, *y, *z, *radius;
  const std::uint32_t* numbers;
  std::span<const Run> runs;
};

// Appends the spheres that rays of the packet touch. Returns false if there are too many. With the
// vector c from the place to a centre, the vector o to a ray's origin and its direction d:
//
//   s = (c - o) d, limited to the ray's length: along;  |c - o - along d|² = |c - o|² - along (2 s -
//   along)
//
// `margins` are radius² - |c|², so that a gap is compared with few operations.
__attribute__((target("avx2,fma"))) bool TestByAvx2(const PacketRays& rays,
                                                    const NearSpheres& spheres,
                                                    TouchedSpheres& found) {
  const __m256 dx = _mm256_load_ps(rays.dx.data()), dy = _mm256_load_ps(rays.dy.data());
  const __m256 dz = _mm256_load_ps(rays.dz.data()), start = _mm256_load_ps(rays.start.data());
  const __m256 ox = _mm256_load_ps(rays.ox.data()), oy = _mm256_load_ps(rays.oy.data());
  const __m256 oz = _mm256_load_ps(rays.oz.data()), square = _mm256_load_ps(rays.square.data());
  const __m256 length = _mm256_load_ps(rays.length.data()), zero = _mm256_setzero_ps();
  const __m256 place_x = _mm256_set1_ps(rays.place_x), place_y = _mm256_set1_ps(rays.place_y);
  const __m256 place_z = _mm256_set1_ps(rays.place_z), rounding = _mm256_set1_ps(rays.rounding);
  const __m256 reach = _mm256_set1_ps(rays.reach);
  const __m256 reach_square = _mm256_set1_ps(2 * rays.reach * rays.reach);
  alignas(32) std::array<float, 8> cx, cy, cz, margins;
  std::size_t touched = found.count;
  const Run* run = spheres.runs.data();
  const Run* const end_of_runs = run + spheres.runs.size();
  for (std::uint32_t first = run->first; run != end_of_runs;) {
    if (touched + 8 > TouchedSpheres::kMax) return false;
    const __m256 x = _mm256_loadu_ps(&spheres.x[first]) - place_x;
    const __m256 y = _mm256_loadu_ps(&spheres.y[first]) - place_y;
    const __m256 z = _mm256_loadu_ps(&spheres.z[first]) - place_z;
    const __m256 radius = _mm256_loadu_ps(&spheres.radius[first]) + rounding;
    const __m256 away = x * x + y * y + z * z, furthest = radius + reach;
    const __m256 is_near = _mm256_cmp_ps(away, furthest * furthest, _CMP_LE_OQ);
    auto lanes = static_cast<unsigned>(_mm256_movemask_ps(is_near));
    const std::uint32_t count = std::min(run->end - first, 8u);
    lanes &= (1u << count) - 1;
    _mm256_store_ps(cx.data(), x), _mm256_store_ps(cy.data(), y), _mm256_store_ps(cz.data(), z);
    const __m256 error = _mm256_set1_ps(kSquareRounding) * (away + reach_square);
    _mm256_store_ps(margins.data(), radius * radius + error - away);
    for (; lanes != 0; lanes &= lanes - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(lanes));
      const __m256 c_x = _mm256_set1_ps(cx[lane]), c_y = _mm256_set1_ps(cy[lane]);
      const __m256 c_z = _mm256_set1_ps(cz[lane]);
      const __m256 s =
          _mm256_fmadd_ps(c_x, dx, _mm256_fmadd_ps(c_y, dy, _mm256_fmsub_ps(c_z, dz, start)));
      const __m256 along = _mm256_min_ps(_mm256_max_ps(s, zero), length);
      const __m256 apart =
          _mm256_fmadd_ps(c_x, ox, _mm256_fmadd_ps(c_y, oy, _mm256_fmadd_ps(c_z, oz, square)));
      const __m256 gap = _mm256_fnmadd_ps(along, s + s - along, apart);
      const __m256 touches = _mm256_cmp_ps(gap, _mm256_set1_ps(margins[lane]), _CMP_LE_OQ);
      const auto mask = static_cast<unsigned>(_mm256_movemask_ps(touches)) & rays.used;
      // Each sphere is written, and the next sphere overwrites it if no ray touches it. This needs
      // no branch, which the processor could hardly predict.
      found.touched[touched] = {spheres.numbers[first + lane], mask};
      touched += mask != 0;
    }
    first += count;
    if (first == run->end && ++run != end_of_runs) first = run->first;
  }
  found.count = touched;
  return true;
}

bool TestBySse(const PacketRays& rays, const NearSpheres& spheres, TouchedSpheres& found) {
  for (const Run& run : spheres.runs) {
    for (std::uint32_t at = run.first; at < run.end; ++at) {
      if (found.count == TouchedSpheres::kMax) return false;
      const float x = spheres.x[at] - rays.place_x, y = spheres.y[at] - rays.place_y;
      const float z = spheres.z[at] - rays.place_z, radius = spheres.radius[at] + rays.rounding;
      const float away = x * x + y * y + z * z;
      const float error = kSquareRounding * (away + 2 * rays.reach * rays.reach);
      const __m128 margin = _mm_set1_ps(radius * radius + error - away);
      const __m128 c_x = _mm_set1_ps(x), c_y = _mm_set1_ps(y), c_z = _mm_set1_ps(z);
      unsigned mask = 0;
      for (std::size_t four = 0; four < RayPacket::kMax; four += 4) {
        const auto load = [four](const PacketRays::Floats& of) { return _mm_load_ps(&of[four]); };
        const __m128 s =
            c_x * load(rays.dx) + (c_y * load(rays.dy) + (c_z * load(rays.dz) - load(rays.start)));
        const __m128 along = _mm_min_ps(_mm_max_ps(s, _mm_setzero_ps()), load(rays.length));
        const __m128 apart =
            c_x * load(rays.ox) + (c_y * load(rays.oy) + (c_z * load(rays.oz) + load(rays.square)));
        const __m128 touches = _mm_cmple_ps(apart - along * (s + s - along), margin);
        mask |= static_cast<unsigned>(_mm_movemask_ps(touches)) << four;
      }
      mask &= rays.used;
      found.touched[found.count] = {spheres.numbers[at], mask};
      found.count += mask != 0;
    }
  }
  return true;
}

}  // namespace

PacketSearch::PacketSearch(const RayPacket& packet, const Vector3& place, double reach)
    : place_(place), reach_(reach) {
  rays_.place_x = static_cast<float>(place.x);
  rays_.place_y = static_cast<float>(place.y);
  rays_.place_z = static_cast<float>(place.z);
  rays_.reach = static_cast<float>(reach * (1 + kRounding));
  rays_.rounding =
      static_cast<float>(kRounding * reach + kCoordinateRounding * (SumOfSizes(place) + reach));
  rays_.used = (1u << packet.count) - 1;
  for (std::size_t i = 0; i < RayPacket::kMax; ++i) {
    const double x = packet.origin_x[i] - place.x, y = packet.origin_y[i] - place.y;
    const double z = packet.origin_z[i] - place.z;
    const double dx = packet.direction_x[i], dy = packet.direction_y[i];
    const double dz = packet.direction_z[i];
    rays_.dx[i] = static_cast<float>(dx);
    rays_.dy[i] = static_cast<float>(dy);
    rays_.dz[i] = static_cast<float>(dz);
    rays_.ox[i] = static_cast<float>(-2 * x);
    rays_.oy[i] = static_cast<float>(-2 * y);
    rays_.oz[i] = static_cast<float>(-2 * z);
    rays_.start[i] = static_cast<float>(x * dx + y * dy + z * dz);
    rays_.square[i] = static_cast<float>(x * x + y * y + z * z);
    rays_.length[i] = static_cast<float>(packet.max_distance[i]);
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
    // If there are only a few spheres, none is listed separately: they share one cell.
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
  for (std::vector<float>* each : {&x_, &y_, &z_, &radius_}) each->resize(end + kRead);
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
    found.touched[found.count++] = {large.number, search.rays_.used};
  }
  return true;
}

bool SphereGrid::FindTouched(const PacketSearch& search, TouchedSpheres& found) const {
  if (!is_suitable_) return false;
  if (!AddLarge(search, found)) return false;
  if (numbers_.empty()) return true;
  static const bool has_avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  const double reach = search.reach_ + max_radius_ + search.rays_.rounding;
  const Vector3& place = search.place_;
  const int left = ColumnOf(place.x - reach), right = ColumnOf(place.x + reach);
  const int front = RowOf(place.y - reach), back = RowOf(place.y + reach);
  std::array<Run, kMaxRows> runs;
  std::size_t run_count = 0, tested = 0;
  if (back - front >= static_cast<int>(kMaxRows)) return false;
  for (int row = front; row <= back; ++row) {
    const std::uint32_t* const starts = &starts_[std::size_t(row) * columns_];
    runs[run_count] = {starts[left], starts[right + 1]};
    tested += runs[run_count].end - runs[run_count].first;
    run_count += runs[run_count].first != runs[run_count].end;
  }
  if (tested > kMaxTested) return false;
  if (run_count == 0) return true;
  const NearSpheres near{x_.data(),      y_.data(),       z_.data(),
                         radius_.data(), numbers_.data(), std::span(runs).first(run_count)};
  return has_avx2 ? TestByAvx2(search.rays_, near, found) : TestBySse(search.rays_, near, found);
}

}  // namespace gsv::sensing
