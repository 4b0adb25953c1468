// The time at which two pieces that move along arcs first touch.
//
// Method   conservative advancement along separating axes: the pieces' closest points give an axis;
//          along it each corner's approach is bounded by its speed plus half its centripetal
//          acceleration times time squared; until the first pair of corners can have closed the gap
//          nothing touches, so time is advanced by that much, and again. It never steps over a
//          contact, however fast the pieces or thin the walls.
// Gaps     pieces that meet are stopped kStopGap apart, give or take half of it, so that they never
//          overlap by rounding; kTouchGap or less counts as contact. Pieces that start closer than
//          that (or overlap) may part and slide but not close in further.
// Units    metres, seconds.
#pragma once

#include <optional>

#include "gsv/dynamics/shapes/convex_piece.h"
#include "gsv/geometry/planar_motion.h"

namespace gsv::dynamics {

inline constexpr double kTouchGap = 1e-6;
inline constexpr double kStopGap = 0.5e-6;

// A piece of a base, given in the base's frame, and how the base moves.
struct MovingPiece {
  const ConvexPiece* piece = nullptr;
  geometry::PlanarPosition start;  // at time 0
  geometry::Twist twist;           // velocity from then on
};

inline void Place(const ConvexPiece& piece, const geometry::PlanarPosition& at,
                  ConvexPiece& placed) {
  Place(piece, at.x, at.y, at.cosine, at.sine, placed);
}

struct Impact {
  double time = 0;
  Vector2 normal;                  // points from the first to the second
  bool first_approaches = false;   // its own motion closes the gap
  bool second_approaches = false;  // at least one of the two approaches
};

// The first contact in [0, end) after which the motions would cause an overlap. `normal` is the
// result of Separate() for the pieces at their starts.
std::optional<Impact> FindImpact(const MovingPiece& first, const MovingPiece& second, double end,
                                 Vector2 normal);

// Finds the impact on a static piece. The piece is given in the world frame.
std::optional<Impact> FindImpact(const MovingPiece& first, const ConvexPiece& standing, double end,
                                 Vector2 normal);

}  // namespace gsv::dynamics
