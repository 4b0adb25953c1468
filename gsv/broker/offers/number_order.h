// Sorts large arrays of numbers, for the preferences `min` and `max`.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace gsv::broker {

// Returns the indices of `numbers` in ascending order. NaN comes last, and equal numbers keep their
// order. A long double holds every int64 and double exactly.
std::vector<std::uint32_t> AscendingOrder(const std::vector<long double>& numbers);
std::vector<std::uint32_t> AscendingOrder(std::span<const double> numbers);

}  // namespace gsv::broker
