// What a camera would see if it knew what it sees: how far each pixel's thing is, whose it is, and
// which of its visuals.
//
// What is see-through is not seen. What is smaller than a third of a pixel may be left out.
#pragma once

#include <cstdint>
#include <vector>

namespace gsv::rendering {

// Rows from the top.
struct GroundTruth {
  int width = 0, height = 0;
  std::vector<float> depth;        // m along the view, not along the pixel's ray; infinite: nothing
  std::vector<std::int32_t> body;  // index in the layout; -1: nothing
  // Number among its body's visuals, counted through the links in their order; -1: nothing.
  std::vector<std::int32_t> visual;
};

}  // namespace gsv::rendering
