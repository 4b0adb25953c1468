// The parameters of the social force model (social_force.h).
#pragma once

namespace gsv::dynamics {

// The parameters have the letters of social_force.h.
// The rotation of the force of another pedestrian, to the right.
inline constexpr double kAside = 0.1;  // rad
// The radius of the paper's pedestrians, see Apart().
inline constexpr double kPaperRadius = 0.1;  // m
// The strength V0 and the range sigma of the force of another pedestrian.
inline constexpr double kOtherStrength = 2.1, kOtherRange = 0.3;  // m²/s², m
// The time dt.
inline constexpr double kStride = 2;  // s
// The largest angle between e and the direction to another pedestrian who is seen.
inline constexpr double kHalfSight = 1.7453292519943295;  // rad: 100 degrees
inline constexpr double kUnseen = 0.5;  // the weight w of others behind the pedestrian
// The minimum length of Apart(), m.
inline constexpr double kClosest = 0.05;
inline constexpr double kMinSquare = 4e-6;  // m²: minimum of (2 b)²
// Shorter vectors have no direction.
inline constexpr double kNoLength = 1e-9;  // m

}  // namespace gsv::dynamics
