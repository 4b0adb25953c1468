// A depth and label image: for each pixel the depth, the body and its visual.
//
// Transparent surfaces are left out. Objects smaller than a third of a pixel may be left out.
#pragma once

#include <cstdint>
#include <vector>

namespace gsv::rendering {

// For each pixel, in rows from the top: depth, body and visual.
struct GroundTruth {
  int width = 0, height = 0;
  // depth in m along the camera's axis, not along the pixel's ray; infinite for the background
  std::vector<float> depth;
  std::vector<std::int32_t> body;  // index of the body in the layout; -1 for the background
  // Index among the body's visuals, in the order of links; -1 for the background.
  std::vector<std::int32_t> visual;
};

}  // namespace gsv::rendering
