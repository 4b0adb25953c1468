// A bounding volume hierarchy (BVH, Embree's) that finds all boxes on a ray.
//
// The caller gives boxes in double precision. The boxes are rounded outwards and padded. The caller
// computes the intersection with the content of each box. The tree finds every box on the ray
// within the ray's current length, if the ray starts within ten times the extent of the boxes. The
// extent is the largest absolute coordinate of a box. For such rays, the error of single precision
// is smaller than the padding, which is 1e-6 m plus 2e-6 of the extent.
//
// Threads  const members may run concurrently.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "gsv/geometry/triangle_mesh.h"
#include "gsv/sensing/rays/ray_scene.h"

namespace gsv::sensing {

// Finds the boxes on a ray.
class BoundingVolumeTree {
 public:
  BoundingVolumeTree();
  ~BoundingVolumeTree();
  BoundingVolumeTree(const BoundingVolumeTree&) = delete;
  BoundingVolumeTree& operator=(const BoundingVolumeTree&) = delete;

  // Replaces all boxes. If `often` is true, the boxes are replaced often, so a fast build matters
  // more than fast rays.
  void Build(std::span<const geometry::Bounds> boxes, bool often);

  class Visitor {
   public:
    virtual ~Visitor() = default;
    // Called for a box that the ray may hit. Returns the new length of the ray, which must not
    // exceed the present length.
    virtual double Visit(std::uint32_t box) = 0;
  };
  // Calls Visit() for each box that the ray may hit.
  void Cast(const Ray& ray, Visitor& visitor) const;

  // Calls visit(box) for every box that the ray may pass through within `length`, which `visit` may
  // shorten.
  template <class Visit>
  void Find(const Ray& ray, const double& length, const Visit& visit) const {
    Caller<Visit> caller(length, visit);
    Cast({ray.origin, ray.direction, length}, caller);
  }

 private:
  template <class Call>
  struct Caller final : Visitor {
    const double& length;
    const Call& call;
    Caller(const double& l, const Call& c) : length(l), call(c) {}
    double Visit(std::uint32_t box) override {
      call(box);
      return length;
    }
  };
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace gsv::sensing
