// Sorts large arrays of numbers, for the preferences `min` and `max`.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gsv::broker {

// Returns the indices of `numbers` in ascending order. NaN comes last, and equal numbers keep their
// order. A long double represents every int64 and double exactly.
std::vector<std::uint32_t> AscendingOrder(const std::vector<long double>& numbers);
std::vector<std::uint32_t> AscendingOrder(std::span<const double> numbers);
// Returns the first `count` elements of AscendingOrder(numbers), without
// sorting the other numbers.
std::vector<std::uint32_t> AscendingOrder(std::span<const double> numbers, std::size_t count);

}  // namespace gsv::broker
