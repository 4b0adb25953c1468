// Antialiasing of finished images: comparable to four samples per pixel at edges, at a small part
// of the cost on a processor.
//
// This is morphological antialiasing (Reshetov 2009) with surfaces instead of colours, so that
// textures and shadows stay sharp. Every pixel has the number of its surface. An edge is a border
// between pixels with different numbers. The steps of an edge along rows and columns determine its
// line, and the line the fraction of each pixel beyond it. Only steps of one pixel belong to a
// line, so that corners stay corners.
#pragma once

#include <cstdint>
#include <vector>

#include "gsv/model/image.h"

namespace gsv::rendering {

// `rgba` holds rows from top to bottom; alpha is the number of the surface.
[[nodiscard]] model::Image SmoothAliasedEdges(int width, int height, const std::uint8_t* rgba);

}  // namespace gsv::rendering
