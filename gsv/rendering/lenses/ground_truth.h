// What a camera would see if it knew what it sees: how far each pixel's thing is, and whose it is.
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
};

}  // namespace gsv::rendering
