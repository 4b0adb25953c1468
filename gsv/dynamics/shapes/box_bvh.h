// A bounding volume hierarchy (BVH) of boxes, built once.
#pragma once

#include <span>
#include <vector>

#include "gsv/geometry/vector3.h"

namespace gsv::dynamics {

// Finds the boxes that overlap a given box.
class BoxBvh {
 public:
  // A box whose edges are parallel to the axes of one frame, in which all boxes are given.
  struct Box {
    geometry::Vector3 low, high;  // corners with the smallest and the largest coordinates, m
  };

  // Builds the tree, and discards an earlier one.
  void Build(std::span<const Box> boxes);

  // Calls `use` with the index of each box that overlaps the box from `low` to `high`. The order
  // depends only on the boxes from which the tree was built.
  template <typename Use>
  void ForEachNear(const geometry::Vector3& low, const geometry::Vector3& high,
                   const Use& use) const {
    // Each level halves the number of boxes and leaves one more node on the stack. So 64 entries
    // suffice.
    int stack[64];
    int depth = 0;
    if (!nodes_.empty()) stack[depth++] = 0;
    while (depth > 0) {
      const Node& node = nodes_[static_cast<std::size_t>(stack[--depth])];
      if (!Meets(node.box, low, high)) continue;
      if (node.right >= 0) {
        stack[depth++] = node.right;
        stack[depth++] = static_cast<int>(&node - nodes_.data()) + 1;
        continue;
      }
      for (int i = node.first; i < node.first + node.count; ++i) {
        const Entry& entry = entries_[static_cast<std::size_t>(i)];
        if (Meets(entry.box, low, high)) use(entry.index);
      }
    }
  }

 private:
  // A box that was passed to Build().
  struct Entry {
    Box box;
    int index;  // index of the box in the argument of Build()
  };
  // The left child is stored directly after its parent.
  struct Node {
    Box box;                   // contains all boxes below this node
    int right = -1;            // index of the right child; -1 for a leaf
    int first = 0, count = 0;  // range of a leaf's boxes in entries_
  };

  // Whether a box overlaps the box from `low` to `high`, or touches it.
  static bool Meets(const Box& box, const geometry::Vector3& low, const geometry::Vector3& high) {
    return box.low.x <= high.x && low.x <= box.high.x && box.low.y <= high.y &&
           low.y <= box.high.y && box.low.z <= high.z && low.z <= box.high.z;
  }
  // Builds the subtree of `count` entries from `first` on. Returns the index of its root.
  int BuildNode(int first, int count);

  std::vector<Entry> entries_;
  std::vector<Node> nodes_;
};

}  // namespace gsv::dynamics
