// Converts between sRGB values (IEC 61966-2-1) and linear light.
#pragma once

#include <cstdint>

namespace gsv::rendering {

// Returns the light from 0 (black) to 1 (white).
float LightOf(std::uint8_t number);
// Returns the sRGB value whose light is nearest.
std::uint8_t NumberFor(float light);

}  // namespace gsv::rendering
