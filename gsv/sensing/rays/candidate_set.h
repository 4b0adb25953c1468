// The candidate set of solids near one point. It is gathered once for many rays that start near
// this point.
//
// Exactness  candidates are culled by bounding spheres in single precision. The spheres are
//            enlarged by more than the error of single precision, so that no solid on a ray is
//            omitted.
// Threads    const members may run concurrently.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <xmmintrin.h>

#include "gsv/sensing/rays/ray_scene.h"

namespace gsv::sensing {

// A bounding sphere.
struct BoundingSphere {
  geometry::Vector3 centre;  // in the frame of the solids that it bounds, m
  double radius = 0;         // m
};

// Returns the bounding box of a sphere.
inline geometry::Bounds BoundsOf(const BoundingSphere& sphere) {
  const geometry::Vector3 reach{sphere.radius, sphere.radius, sphere.radius};
  return {sphere.centre - reach, sphere.centre + reach};
}

// The solids near a point. Rays from there may hit these solids.
class CandidateSet {
 public:
  // Maximum number of solids. Larger sets are slower than the broad phase.
  static constexpr std::size_t kMax = 64;

  // Clears the set. The solids that are added after this call must be all the solids within `reach`
  // (m) of `place`.
  void Begin(const geometry::Vector3& place, double reach);

  const geometry::Vector3& place() const { return place_; }
  double reach() const { return reach_; }

  // Adds a solid with its bounding sphere if `counts` is true. `number` is the solid's number in
  // the scene.
  void Add(const BoundingSphere& ball, std::uint32_t number, bool counts) {
    if (count_ == kMax) {
      is_overfull_ = is_overfull_ || counts;
      return;
    }
    const geometry::Vector3 centre = ball.centre - place_;
    const double grown = ball.radius + kRounding * (std::abs(centre.x) + std::abs(centre.y) +
                                                    std::abs(centre.z) + ball.radius + reach_);
    x_[count_] = static_cast<float>(centre.x);
    y_[count_] = static_cast<float>(centre.y);
    z_[count_] = static_cast<float>(centre.z);
    squared_radius_[count_] = static_cast<float>(grown * grown);
    numbers_[count_] = number;
    // There is no branch, because the processor could hardly predict `counts`.
    count_ += counts;
  }

  // Ends the gathering. Returns false if there were too many solids.
  bool Finish();

  // Whether the set contains all solids that the ray may hit.
  bool Covers(const Ray& ray) const {
    return Norm(ray.origin - place_) + ray.max_distance <= reach_;
  }

  // Calls visit(number) for every solid that the ray may hit within `length` (m). `visit` may
  // reduce `length`, for example to the distance of a hit: it is read again after every four
  // solids.
  template <class Visit>
  void Find(const Ray& ray, const double& length, const Visit& visit) const {
    const geometry::Vector3 origin = ray.origin - place_;
    const __m128 ox = Four(origin.x), oy = Four(origin.y), oz = Four(origin.z);
    const __m128 dx = Four(ray.direction.x), dy = Four(ray.direction.y), dz = Four(ray.direction.z);
    for (std::size_t i = 0; i < count_; i += 4) {
      const __m128 x = _mm_load_ps(&x_[i]) - ox, y = _mm_load_ps(&y_[i]) - oy;
      const __m128 z = _mm_load_ps(&z_[i]) - oz;
      // The point of the ray that is nearest to the sphere's centre.
      const __m128 along =
          _mm_min_ps(_mm_max_ps(x * dx + y * dy + z * dz, _mm_setzero_ps()), Four(length));
      const __m128 gap_x = x - along * dx, gap_y = y - along * dy, gap_z = z - along * dz;
      const __m128 gap = gap_x * gap_x + gap_y * gap_y + gap_z * gap_z;
      auto touched = static_cast<unsigned>(
          _mm_movemask_ps(_mm_cmple_ps(gap, _mm_load_ps(&squared_radius_[i]))));
      for (; touched != 0; touched &= touched - 1) visit(numbers_[i + std::countr_zero(touched)]);
    }
  }

 private:
  // Spheres are enlarged by this fraction of the coordinates. The fraction exceeds the rounding
  // error: single precision has a relative error of 6e-8, and the distance between ray and centre
  // takes a dozen operations.
  static constexpr double kRounding = 4e-6;

  // Returns four copies of the number in single precision.
  static __m128 Four(double x) { return _mm_set1_ps(static_cast<float>(x)); }

  geometry::Vector3 place_;  // in the world, m
  double reach_ = -1;        // m; negative before Begin()
  // number of solids; after them there are up to three entries that no ray hits
  std::size_t count_ = 0;
  bool is_overfull_ = false;  // whether a solid had no space
  // Centres relative to place_.
  alignas(16) std::array<float, kMax + 4> x_, y_, z_, squared_radius_;
  std::array<std::uint32_t, kMax> numbers_;  // numbers of the solids in the scene
};

}  // namespace gsv::sensing
