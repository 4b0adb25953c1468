// The bounding boxes of the rays of a packet.
//
// Units  metres, in the frame of the rays.
#pragma once

#include <array>
#include <cstddef>

#include <emmintrin.h>

#include "gsv/geometry/triangle_mesh.h"
#include "gsv/sensing/rays/ray_packet.h"

namespace gsv::sensing {

// Bounding boxes of the rays, from each ray's origin to its end. Rays must be finite.
class PacketBounds {
 public:
  explicit PacketBounds(const RayPacket& rays) {
    for (std::size_t i = 0; i < kPairs; ++i) {
      const __m128d length = _mm_load_pd(&rays.max_distance[2 * i]);
      const auto set = [&](Spans& spans, const RayPacket::Coordinates& origin,
                           const RayPacket::Coordinates& direction) {
        const __m128d from = _mm_load_pd(&origin[2 * i]);
        const __m128d to = from + length * _mm_load_pd(&direction[2 * i]);
        spans[i] = {_mm_min_pd(from, to), _mm_max_pd(from, to)};
      };
      set(x_, rays.origin_x, rays.direction_x);
      set(y_, rays.origin_y, rays.direction_y);
      set(z_, rays.origin_z, rays.direction_z);
    }
  }

  // Returns a mask of the rays whose boxes touch `box`: bit i stands for ray i. The bits of unused
  // rays have no meaning.
  unsigned Touching(const geometry::Bounds& box) const {
    unsigned mask = 0;
    for (std::size_t i = 0; i < kPairs; ++i) {
      const __m128d level =
          _mm_and_pd(Meet(x_[i], box.min.x, box.max.x), Meet(y_[i], box.min.y, box.max.y));
      const __m128d touches = _mm_and_pd(level, Meet(z_[i], box.min.z, box.max.z));
      mask |= static_cast<unsigned>(_mm_movemask_pd(touches)) << (2 * i);
    }
    return mask;
  }

 private:
  static constexpr std::size_t kPairs = RayPacket::kMax / 2;
  // The intervals of two rays along an axis.
  struct Span {
    __m128d low, high;  // in the world, m
  };
  using Spans = std::array<Span, kPairs>;

  // Returns a mask of the rays whose interval overlaps [low, high].
  static __m128d Meet(const Span& span, double low, double high) {
    return _mm_and_pd(_mm_cmple_pd(_mm_set1_pd(low), span.high),
                      _mm_cmple_pd(span.low, _mm_set1_pd(high)));
  }

  Spans x_, y_, z_;  // along the axes of the world
};

}  // namespace gsv::sensing
