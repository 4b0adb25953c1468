// Writes a depth grid into a JPEG, as an application segment (APP9) that other readers skip.
//
// Format  the identifier kDepthIdentifier with its final zero; then, little endian: width, height
//         and spacing of the grid (uint16 each), and the scale s (float32); then a code for each
//         sample. A sample is the number q = round(s / depth), 0 for the background, where s is
//         65535 times the smallest depth. A code is the difference, modulo 2^16, between q and its
//         prediction left + above - above_left (numbers outside the grid count as 0), as a zigzag
//         number (0, -1, 1, -2, ...) in groups of three bits from the lowest. A group is four bits:
//         the lowest three are bits of the number, and the highest is set if a group follows. Each
//         byte has two groups, the lower half first.
// Size    at most 3 bytes per sample.
#pragma once

#include <cstdint>
#include <vector>

#include "gsv/rendering/lenses/depth_grid.h"

namespace gsv::rendering {

inline constexpr char kDepthIdentifier[] = "GSV-depth";
// With at most this number of samples, a segment is never too long for a JPEG.
inline constexpr int kMaxDepthSamples = 20'000;

// Returns the content of the segment. `grid` must have at most kMaxDepthSamples samples.
std::vector<std::uint8_t> EncodeDepth(const DepthGrid& grid);

// Inserts the segment after the first segment of `jpeg`.
void InsertDepth(const DepthGrid& grid, std::vector<std::uint8_t>& jpeg);

}  // namespace gsv::rendering
