// Pairs of a ray and a shape near it, for packets of rays. The distances of four pairs are computed
// at once, on processors with AVX2.
//
// Exactness  the functions compute the same operations in the same order as Moved() and
//            DistanceToShape(). So the distances are bit-identical. For a branch, both cases are
//            computed, and one is selected.
// Threads    none; each thread has its own pairs.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "gsv/geometry/pose.h"
#include "gsv/geometry/shape.h"
#include "gsv/sensing/rays/ray_packet.h"

namespace gsv::sensing {

// Poses as a structure of arrays.
template <std::size_t kCount>
struct PoseLanes {
  using Lanes = std::array<double, kCount>;
  alignas(32) Lanes x{}, y{}, z{}, qw{}, qx{}, qy{}, qz{};

  // Sets pose i.
  void Set(std::size_t i, const geometry::Pose& pose) {
    x[i] = pose.position.x, y[i] = pose.position.y, z[i] = pose.position.z;
    qw[i] = pose.orientation.w, qx[i] = pose.orientation.x;
    qy[i] = pose.orientation.y, qz[i] = pose.orientation.z;
  }
};

// Pairs whose shapes have equal types: cylinders or boxes.
class RayPairs {
 public:
  static constexpr std::size_t kMax = 8;
  using Lanes = std::array<double, kMax>;

  // Whether this processor has AVX2. Without it, RayPairs must not be used.
  static bool AreFast();

  std::size_t count() const { return count_; }
  bool is_full() const { return count_ == kMax; }
  // Removes all pairs.
  void Clear() { count_ = 0; }

  // Adds ray i of the packet and a shape in a set. `part_from_world` is the pose of the world in
  // the frame of the set's part; null if the set's frame is the world.
  void Add(const RayPacket& packet, std::size_t i, const geometry::Pose* part_from_world,
           const geometry::Pose& shape_from_set, const geometry::Box& box) {
    AddRay(packet, i, part_from_world, shape_from_set);
    size_x_[count_] = 0.5 * box.size.x, size_y_[count_] = 0.5 * box.size.y;
    size_z_[count_++] = 0.5 * box.size.z;
  }
  void Add(const RayPacket& packet, std::size_t i, const geometry::Pose* part_from_world,
           const geometry::Pose& shape_from_set, const geometry::Cylinder& cylinder) {
    AddRay(packet, i, part_from_world, shape_from_set);
    size_x_[count_] = cylinder.radius, size_z_[count_++] = cylinder.length / 2;
  }

  // Computes the distances to boxes or cylinders. All pairs have parts, or none has.
  template <class Shape, bool kHaveParts>
  void Cast();

  // The results of Cast() for pair k: the number of the ray, and the distance. The distance may be
  // beyond the ray's length. It is infinite if the ray's line misses the shape, or if the shape is
  // behind the ray's origin.
  std::size_t ray(std::size_t k) const { return rays_[k]; }
  double distance(std::size_t k) const { return distances_[k]; }

 private:
  void AddRay(const RayPacket& packet, std::size_t i, const geometry::Pose* part_from_world,
              const geometry::Pose& shape_from_set) {
    rays_[count_] = static_cast<std::uint8_t>(i);
    ox_[count_] = packet.origin_x[i], oy_[count_] = packet.origin_y[i];
    oz_[count_] = packet.origin_z[i];
    dx_[count_] = packet.direction_x[i], dy_[count_] = packet.direction_y[i];
    dz_[count_] = packet.direction_z[i];
    if (part_from_world != nullptr) parts_.Set(count_, *part_from_world);
    shapes_.Set(count_, shape_from_set);
  }

  std::size_t count_ = 0;                  // number of pairs
  std::array<std::uint8_t, kMax> rays_{};  // for each pair, the index of its ray in the packet
  // Cast() also computes the unused lanes after the last pair. They hold zeros or the values of
  // earlier pairs. So they hold no subnormal numbers, which would slow the computation down.
  alignas(32) Lanes ox_{}, oy_{}, oz_{}, dx_{}, dy_{}, dz_{};  // in the world
  PoseLanes<kMax> parts_, shapes_;                             // part_from_world, shape_from_set
  // The halves of a box's sides. For a cylinder, x is the radius and z is half of the length.
  alignas(32) Lanes size_x_{}, size_y_{}, size_z_{};
  alignas(32) Lanes distances_{};  // results of Cast(), m
};

}  // namespace gsv::sensing
