// Converts between sRGB values (IEC 61966-2-1) and linear light.
#pragma once

#include <cstdint>

namespace gsv::rendering {

// Returns the linear light of an sRGB value, from 0 (black) to 1 (white).
float LightOf(std::uint8_t number);
// Encodes linear light as sRGB, and returns the nearest integer.
std::uint8_t NumberFor(float light);

}  // namespace gsv::rendering
