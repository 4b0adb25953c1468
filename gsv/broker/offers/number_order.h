// The order of numbers, many at a time.
#pragma once

#include <cstdint>
#include <vector>

namespace gsv::broker {

// The indices of `numbers` in ascending order: NaN last, equal ones as they came. A long double
// holds every int64 and double exactly.
std::vector<std::uint32_t> AscendingOrder(const std::vector<long double>& numbers);

}  // namespace gsv::broker
