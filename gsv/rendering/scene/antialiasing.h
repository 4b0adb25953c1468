// Anti-aliasing of finished pictures: what four samples a pixel would show along the edges of
// things, at a small part of their price where a processor draws.
//
// Every pixel comes with the number of the surface it shows. Where the numbers of neighbours differ
// there is an edge, and from the steps it makes along rows and columns follows the line it stands
// for and how much of each pixel lies on the line's other side (morphological anti-aliasing,
// Reshetov 2009, by surfaces instead of colours, so that textures and shadows stay sharp). Corners
// stay corners: only steps of one pixel count as those of a line.
#pragma once

#include <cstdint>
#include <vector>

#include "gsv/model/image.h"

namespace gsv::rendering {

// `rgba` holds rows from top to bottom; alpha is the number of the surface.
[[nodiscard]] model::Image SmoothAliasedEdges(int width, int height, const std::uint8_t* rgba);

}  // namespace gsv::rendering
