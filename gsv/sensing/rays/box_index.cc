#include "gsv/sensing/rays/box_index.h"

#include <algorithm>
#include <cmath>

namespace gsv::sensing {
namespace {

using geometry::Bounds;

// Up to this number of boxes, each box is tested.
constexpr std::size_t kFewBoxes = 8;

// Maximum of ColumnGrid::occupancy(), a mean number of boxes. Above this value, the tree is faster,
// for example for boxes that are stacked, or if one box is far from many others.
constexpr double kMaxOccupancy = 12;

bool FitsGrid(const Bounds& b) {
  const auto fits = [](double x) {
    return std::abs(x) <= ColumnGrid::kMaxCoordinate;
  };  // NaN is not in the range
  return fits(b.min.x) && fits(b.min.y) && fits(b.max.x) && fits(b.max.y);
}

}  // namespace

void BoxIndex::Build(std::span<const Bounds> boxes, bool often) {
  count_ = static_cast<std::uint32_t>(boxes.size());
  kind_ = Kind::kList;
  if (boxes.size() <= kFewBoxes) return;
  if (std::all_of(boxes.begin(), boxes.end(), FitsGrid)) {
    kind_ = Kind::kGrid;
    grid_.Build(boxes);
    if (grid_.occupancy() <= kMaxOccupancy) return;
  }
  kind_ = Kind::kTree;
  if (tree_ == nullptr) tree_ = std::make_unique<BoundingVolumeTree>();
  tree_->Build(boxes, often);
}

}  // namespace gsv::sensing
