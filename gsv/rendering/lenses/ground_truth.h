// A depth and label image: for each pixel the depth, the body and its visual.
//
// Transparent surfaces are left out. Objects smaller than a third of a pixel may be left out.
#pragma once

#include <cstdint>
#include <vector>

namespace gsv::rendering {

// Rows are stored from the top.
struct GroundTruth {
  int width = 0, height = 0;
  // in m along the view, not along the pixel's ray; infinite if nothing is hit
  std::vector<float> depth;
  std::vector<std::int32_t> body;  // index in the layout; -1 if nothing is hit
  // Index among the body's visuals, in the order of links; -1 if nothing is hit.
  std::vector<std::int32_t> visual;
};

}  // namespace gsv::rendering
