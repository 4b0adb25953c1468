// Solves dense linear equations of moderate size.
#pragma once

#include <span>

namespace gsv::dynamics {

// Solves a x = b by Gaussian elimination with partial pivoting. `a` has n rows of n values, and `b`
// becomes x. Both are overwritten. Returns false if a pivot is below 1e-13 of the largest value
// that is stored in its row; then `b` is invalid. The result depends only on the arguments.
[[nodiscard]] bool SolveLinear(std::span<double> a, std::span<double> b);

}  // namespace gsv::dynamics
