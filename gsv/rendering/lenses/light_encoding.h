// Converts between sRGB values (IEC 61966-2-1) and linear light.
#pragma once

#include <cstdint>

namespace gsv::rendering {

// Light from 0 (black) to 1 (white).
float LightOf(std::uint8_t number);
// The value with the nearest light.
std::uint8_t NumberFor(float light);

}  // namespace gsv::rendering
