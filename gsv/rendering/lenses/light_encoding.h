// Between a picture's numbers, which are sRGB (IEC 61966-2-1), and light, which adds up.
#pragma once

#include <cstdint>

namespace gsv::rendering {

// From 0 (black) to 1 (white).
float LightOf(std::uint8_t number);
// The number whose light is nearest.
std::uint8_t NumberFor(float light);

}  // namespace gsv::rendering
