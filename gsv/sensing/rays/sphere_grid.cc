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

// Spheres with a radius of more than this number of cells are listed separately.
constexpr double kLargeCells = 2;
constexpr std::size_t kMaxLarge = 32;

// If more spheres or more rows of cells than this are near the rays, single rays are faster.
constexpr std::size_t kMaxTested = 512, kMaxRows = 128;

// Spheres are read in vectors of this length.
constexpr std::size_t kRead = 8;

// Single precision has a relative error of 6e-8. Radii are enlarged by kRounding times the radius
// and the reach, for the errors of the test. They are also enlarged by kCoordinateRounding times
// the coordinates of the centre and of the place, which are rounded to single precision.
constexpr double kRounding = 2e-5, kCoordinateRounding = 1e-6;

double SumOfSizes(const Vector3& v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }

bool Suits(const BoundingSphere& sphere) {
  const auto fits = [](double x) { return std::abs(x) <= kMaxCoordinate; };  // false for NaN
  return fits(sphere.centre.x) && fits(sphere.centre.y) && fits(sphere.centre.z) &&
         fits(sphere.radius);
}

// When a sphere is tested, its squared radius is enlarged by this fraction of the squared
// distances. The fraction exceeds the rounding error of the squared distance between centre and
// ray. Computing this distance takes a dozen operations in single precision.
constexpr float kSquareRounding = 1e-6f;

// Spheres that are side by side, in a row of cells.
struct Run {
  std::uint32_t first, end;
};

// The spheres of a grid, and the runs of spheres that may be in reach. Whole vectors of eight are
// read, so the arrays may be read beyond the last sphere.
struct TestedSpheres {
  const float *x, *y, *z, *radius;
  const std::uint32_t* numbers;
  std::span<const Run> runs;
};

// For each mask of eight lanes, the indices of the lanes in the mask, in ascending order.
constexpr auto kLanesOfMask = [] {
  std::array<std::array<std::uint8_t, kRead>, 1u << kRead> lanes{};
  for (unsigned mask = 0; mask < lanes.size(); ++mask) {
    std::size_t count = 0;
    for (std::uint8_t lane = 0; lane < kRead; ++lane) {
      if ((mask >> lane & 1) != 0) lanes[mask][count++] = lane;
    }
  }
  return lanes;
}();

// The spheres within reach of the place, in the order of the grid. Positions are relative to the
// place.
class SpheresInReach {
 public:
  // Sets the spheres. No branch depends on which spheres are in reach, because the processor could
  // hardly predict it.
  __attribute__((target("avx2,fma,popcnt"))) void Find(const PacketRays& rays,
                                                       const TestedSpheres& spheres) {
    const __m256 place_x = _mm256_set1_ps(rays.place_x), place_y = _mm256_set1_ps(rays.place_y);
    const __m256 place_z = _mm256_set1_ps(rays.place_z), rounding = _mm256_set1_ps(rays.rounding);
    const __m256 reach = _mm256_set1_ps(rays.reach);
    const __m256 reach_square = _mm256_set1_ps(2 * rays.reach * rays.reach);
    count = 0;
    for (const Run& run : spheres.runs) {
      for (std::uint32_t first = run.first; first < run.end; first += kRead) {
        const __m256 x_here = _mm256_loadu_ps(&spheres.x[first]) - place_x;
        const __m256 y_here = _mm256_loadu_ps(&spheres.y[first]) - place_y;
        const __m256 z_here = _mm256_loadu_ps(&spheres.z[first]) - place_z;
        const __m256 radius = _mm256_loadu_ps(&spheres.radius[first]) + rounding;
        const __m256 away = x_here * x_here + y_here * y_here + z_here * z_here;
        const __m256 furthest = radius + reach;
        const __m256 is_near = _mm256_cmp_ps(away, furthest * furthest, _CMP_LE_OQ);
        const std::uint32_t in_run = std::min<std::uint32_t>(run.end - first, kRead);
        const unsigned lanes =
            static_cast<unsigned>(_mm256_movemask_ps(is_near)) & ((1u << in_run) - 1);
        const __m256 error = _mm256_set1_ps(kSquareRounding) * (away + reach_square);
        const __m256i order = _mm256_cvtepu8_epi32(
            _mm_loadl_epi64(reinterpret_cast<const __m128i*>(kLanesOfMask[lanes].data())));
        _mm256_storeu_ps(&x[count], _mm256_permutevar8x32_ps(x_here, order));
        _mm256_storeu_ps(&y[count], _mm256_permutevar8x32_ps(y_here, order));
        _mm256_storeu_ps(&z[count], _mm256_permutevar8x32_ps(z_here, order));
        _mm256_storeu_ps(&margin[count],
                         _mm256_permutevar8x32_ps(radius * radius + error - away, order));
        const auto* const from = reinterpret_cast<const __m256i*>(&spheres.numbers[first]);
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(&number[count]),
                            _mm256_permutevar8x32_epi32(_mm256_loadu_si256(from), order));
        count += static_cast<std::size_t>(std::popcount(lanes));
      }
    }
  }

  using Floats = std::array<float, kMaxTested + kRead>;
  std::size_t count = 0;
  Floats x, y, z;
  // radius² - |c|² for the centre c, plus an allowance for rounding errors. It saves operations
  // when many rays are tested against one sphere.
  Floats margin;
  std::array<std::uint32_t, kMaxTested + kRead> number;
};

// Appends the spheres that rays of the packet touch. Returns false if there are too many. With the
// vector c from the place to a centre, the vector o to a ray's origin and its direction d:
//
//   s = (c - o) d
//   along = s, limited to the range from 0 to the ray's length
//   squared distance = |c - o - along d|² = |c - o|² - along (2 s - along)
__attribute__((target("avx2,fma,popcnt"))) bool TestByAvx2(const PacketRays& rays,
                                                           const TestedSpheres& spheres,
                                                           TouchedSpheres& found) {
  SpheresInReach near;
  near.Find(rays, spheres);
  const __m256 dx = _mm256_load_ps(rays.dx.data()), dy = _mm256_load_ps(rays.dy.data());
  const __m256 dz = _mm256_load_ps(rays.dz.data()), start = _mm256_load_ps(rays.start.data());
  const __m256 ox = _mm256_load_ps(rays.ox.data()), oy = _mm256_load_ps(rays.oy.data());
  const __m256 oz = _mm256_load_ps(rays.oz.data()), square = _mm256_load_ps(rays.square.data());
  const __m256 length = _mm256_load_ps(rays.length.data()), zero = _mm256_setzero_ps();
  std::size_t touched = found.count;
  for (std::size_t i = 0; i < near.count; ++i) {
    if (touched == TouchedSpheres::kMax) return false;
    const __m256 c_x = _mm256_set1_ps(near.x[i]), c_y = _mm256_set1_ps(near.y[i]);
    const __m256 c_z = _mm256_set1_ps(near.z[i]);
    const __m256 s =
        _mm256_fmadd_ps(c_x, dx, _mm256_fmadd_ps(c_y, dy, _mm256_fmsub_ps(c_z, dz, start)));
    const __m256 along = _mm256_min_ps(_mm256_max_ps(s, zero), length);
    const __m256 apart =
        _mm256_fmadd_ps(c_x, ox, _mm256_fmadd_ps(c_y, oy, _mm256_fmadd_ps(c_z, oz, square)));
    const __m256 gap = _mm256_fnmadd_ps(along, s + s - along, apart);
    const __m256 touches = _mm256_cmp_ps(gap, _mm256_set1_ps(near.margin[i]), _CMP_LE_OQ);
    const auto mask = static_cast<unsigned>(_mm256_movemask_ps(touches)) & rays.used;
    // Each sphere is written. If no ray hits it, the next sphere overwrites it. So this code is
    // branch-free as well.
    found.touched[touched] = {near.number[i], mask};
    touched += mask != 0;
  }
  found.count = touched;
  return true;
}

bool TestBySse(const PacketRays& rays, const TestedSpheres& spheres, TouchedSpheres& found) {
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
  // The side of a cell. Even for a thin row of spheres, the number of cells is not much more than
  // max_cells.
  const double side =
      std::max({std::sqrt(wide * tall / max_cells), wide / max_cells, tall / max_cells, 1e-3});
  cells_per_metre_ = 1 / side;
  columns_ = static_cast<int>(wide * cells_per_metre_) + 1;
  rows_ = static_cast<int>(tall * cells_per_metre_) + 1;
  return true;
}

void SphereGrid::Build(std::span<const BoundingSphere> spheres, std::span<const Bounds> boxes) {
  GSV_CHECK(boxes.empty() || spheres.size() == boxes.size());
  large_.clear();
  count_ = 0;
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
    // If there are only a few spheres, no sphere is listed separately: they share one cell.
    if (sphere.radius > too_large && spheres.size() > kMaxLarge) {
      large_.push_back({boxes.empty() ? BoundsOf(sphere) : boxes[i], i});
      continue;
    }
    max_radius_ = std::max(max_radius_, sphere.radius);
    cell_of_[i] = std::uint32_t(RowOf(sphere.centre.y)) * columns_ + ColumnOf(sphere.centre.x);
    ++starts_[cell_of_[i]];
  }
  is_suitable_ = large_.size() <= kMaxLarge;
  if (!is_suitable_) return;

  // starts_ has the number of spheres of each cell. The loop over starts_ replaces each number by
  // the end of the cell's spheres. Each insertion decrements the end, so it becomes the start.
  std::uint32_t end = 0;
  for (std::uint32_t& start : starts_) start = end += start;
  for (std::vector<float>* each : {&x_, &y_, &z_, &radius_}) each->resize(end + kRead);
  numbers_.resize(end + kRead);
  count_ = end;
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
  if (count_ == 0) return true;
  static const bool has_avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
                               __builtin_cpu_supports("popcnt");
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
  const TestedSpheres spheres{x_.data(),      y_.data(),       z_.data(),
                              radius_.data(), numbers_.data(), std::span(runs).first(run_count)};
  return has_avx2 ? TestByAvx2(search.rays_, spheres, found)
                  : TestBySse(search.rays_, spheres, found);
}

}  // namespace gsv::sensing
