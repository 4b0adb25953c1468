// The time at which two pieces that move along arcs first touch.
//
// Method   Conservative advancement along separating axes. The closest points of the pieces give an
//          axis. Along this axis, the path of each corner is bounded by its speed times the time
//          plus half its centripetal acceleration times the time squared. The pieces cannot touch
//          before a pair of corners can have closed the gap. So the method advances to that
//          instant, and repeats. It never misses a contact.
// Gaps     Pieces that collide are stopped at a distance of kStopGap ± 50 %, so that rounding never
//          makes them overlap. A distance of at most kTouchGap counts as contact. Pieces that are
//          closer at the start (or overlap) may separate and slide, but not approach further.
// Units    metres, seconds.
#pragma once

#include <optional>

#include "gsv/dynamics/shapes/convex_piece.h"
#include "gsv/geometry/planar_motion.h"

namespace gsv::dynamics {

// Distances in m, see "Gaps" above.
inline constexpr double kTouchGap = 1e-6;
inline constexpr double kStopGap = 0.5e-6;

// A piece of a planar body's base, given in the frame of the base, and how the base moves.
struct MovingPiece {
  const ConvexPiece* piece = nullptr;  // never null
  geometry::PlanarPosition start;      // pose of the base at time 0
  geometry::Twist twist;               // constant velocity after time 0
};

inline void Place(const ConvexPiece& piece, const geometry::PlanarPosition& at,
                  ConvexPiece& placed) {
  Place(piece, at.x, at.y, at.cosine, at.sine, placed);
}

// The first contact of two pieces.
struct Impact {
  double time = 0;                 // s
  Vector2 normal;                  // points from the first piece to the second piece
  bool first_approaches = false;   // the first piece moves towards the second
  bool second_approaches = false;  // the second piece moves towards the first
};

// Returns the first contact in [0, end) after which the motions would cause an overlap. `normal` is
// the result of Separate() for the pieces at their starts.
std::optional<Impact> FindImpact(const MovingPiece& first, const MovingPiece& second, double end,
                                 Vector2 normal);

// Returns the impact on a static piece, which is given in the world frame.
std::optional<Impact> FindImpact(const MovingPiece& first, const ConvexPiece& standing, double end,
                                 Vector2 normal);

}  // namespace gsv::dynamics
