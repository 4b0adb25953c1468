// Dense linear equations of moderate size.
#pragma once

#include <span>

namespace gsv::dynamics {

// Solves a x = b by Gaussian elimination with partial pivoting: `a` holds n rows of n values, and
// `b` becomes x. Both are overwritten. False if a pivot is below 1e-13 of the largest value
// left in its row; `b` is then worthless. A function of its arguments alone.
[[nodiscard]] bool SolveLinear(std::span<double> a, std::span<double> b);

}  // namespace gsv::dynamics
