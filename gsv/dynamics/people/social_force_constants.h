// The parameters of the social force model (social_force.h).
#pragma once

namespace gsv::dynamics {

inline constexpr double kAside = 0.1;                             // rad
inline constexpr double kPaperRadius = 0.1;                       // m
inline constexpr double kOtherStrength = 2.1, kOtherRange = 0.3;  // m²/s², m
inline constexpr double kStride = 2;                              // s
inline constexpr double kHalfSight = 1.7453292519943295;          // rad: 100 degrees
inline constexpr double kUnseen = 0.5;
// Minimum distance, m; smaller distances are replaced by it.
inline constexpr double kClosest = 0.05;
inline constexpr double kMinSquare = 4e-6;  // m²: minimum of (2 b)²
inline constexpr double kNoLength = 1e-9;   // m

}  // namespace gsv::dynamics
