// A broad phase for rays: a list for few boxes, a grid of columns for boxes side by side, and a
// bounding volume hierarchy (BVH) for others.
//
// Exactness  no box that a ray passes through within its length is left out, within the limits of
//            ColumnGrid and BoundingVolumeTree.
// Threads    const members may run concurrently.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "gsv/sensing/rays/bounding_volume_tree.h"
#include "gsv/sensing/rays/column_grid.h"

namespace gsv::sensing {

// Finds the boxes that a ray passes through, by the method that suits the boxes.
class BoxIndex {
 public:
  // Replaces all boxes. If `often` is true, the boxes are replaced often, so a fast build matters
  // more than fast rays.
  void Build(std::span<const geometry::Bounds> boxes, bool often);

  // Calls visit(box) for every box that the ray may pass through within `length`, which `visit` may
  // shorten. A box may be visited more than once.
  template <class Visit>
  void Walk(const Ray& ray, const double& length, const Visit& visit) const {
    switch (kind_) {
      case Kind::kList:
        for (std::uint32_t i = 0; i < count_; ++i) visit(i);
        return;
      case Kind::kGrid:
        grid_.Walk(ray, length, visit);
        return;
      case Kind::kTree:
        tree_->Find(ray, length, visit);
        return;
    }
  }

  // Adds each box within `reach` (m) of `place` to `found` once. May also add boxes further away.
  // Returns false if there is no space in `found`, or no fast method for these boxes. Some boxes
  // are missing then.
  bool Near(const geometry::Vector3& place, double reach, FoundBoxes& found) const {
    if (kind_ == Kind::kGrid) return grid_.Near(place, reach, found);
    if (kind_ == Kind::kTree || found.count + count_ > FoundBoxes::kMax) return false;
    for (std::uint32_t i = 0; i < count_; ++i) found.boxes[found.count++] = i;
    return true;
  }

 private:
  // The method that suits the boxes.
  enum class Kind { kList, kGrid, kTree };

  Kind kind_ = Kind::kList;
  std::uint32_t count_ = 0;  // number of boxes
  ColumnGrid grid_;
  std::unique_ptr<BoundingVolumeTree> tree_;  // null until it is needed
};

}  // namespace gsv::sensing
