// Sorts many numbers.
#pragma once

#include <cstdint>
#include <vector>

namespace gsv::broker {

// The indices of `numbers` in ascending order. NaN is last; equal numbers keep their order. A long
// double holds every int64 and double exactly.
std::vector<std::uint32_t> AscendingOrder(const std::vector<long double>& numbers);

}  // namespace gsv::broker
