// Mathematical constants. In other namespaces: `using geometry::kPi;`.
#pragma once

#include <limits>
#include <numbers>

namespace gsv::geometry {

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace gsv::geometry
