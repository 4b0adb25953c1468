#include "gsv/dynamics/shapes/box_bvh.h"

#include <algorithm>
#include <utility>

namespace gsv::dynamics {

using geometry::Vector3;

void BoxBvh::Build(std::span<const Box> boxes) {
  entries_.clear();
  nodes_.clear();
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    entries_.push_back({boxes[i], static_cast<int>(i)});
  }
  if (!boxes.empty()) BuildNode(0, static_cast<int>(boxes.size()));
}

// Splits at the median of the longest side.
int BoxBvh::BuildNode(int first, int count) {
  constexpr int kLeaf = 4;
  const int index = static_cast<int>(nodes_.size());
  nodes_.emplace_back();
  const auto begin = entries_.begin() + first, end = begin + count;
  Box box = begin->box;
  for (auto at = begin; at != end; ++at) {
    const auto& [low, high] = at->box;
    box.low = {std::min(box.low.x, low.x), std::min(box.low.y, low.y), std::min(box.low.z, low.z)};
    box.high = {std::max(box.high.x, high.x), std::max(box.high.y, high.y),
                std::max(box.high.z, high.z)};
  }
  int right = -1;
  if (count > kLeaf) {
    const Vector3 size = box.high - box.low;
    const auto middle = [&](const Entry& entry) {
      const Vector3 twice = entry.box.low + entry.box.high;
      return size.x >= size.y && size.x >= size.z ? twice.x
                                                  : (size.y >= size.z ? twice.y : twice.z);
    };
    std::nth_element(begin, begin + count / 2, end, [&](const Entry& a, const Entry& b) {
      return std::pair(middle(a), a.index) < std::pair(middle(b), b.index);
    });
    BuildNode(first, count / 2);
    right = BuildNode(first + count / 2, count - count / 2);
  }
  nodes_[static_cast<std::size_t>(index)] = {box, right, first, count};
  return index;
}

}  // namespace gsv::dynamics
