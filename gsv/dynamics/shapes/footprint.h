// The space that a model occupies, as a few upright prisms.
//
// Frame   the model's, with its z axis up.
// Rule    each collision (at zero joint positions) is a prism over its silhouette, from its lowest
//         to its highest point; one that lies within another is left out. More than kMaxPieces are
//         replaced by kMaxPieces layers, each the hull of all that reaches into it. What meets
//         nothing by its filter is left out; pieces of different filters are never joined, so
//         that a model that has several may have more than kMaxPieces.
#pragma once

#include <vector>

#include "gsv/dynamics/shapes/convex_piece.h"
#include "gsv/dynamics/shapes/silhouette.h"
#include "gsv/model/model.h"

namespace gsv::dynamics {

struct Footprint {
  static constexpr int kMaxPieces = 8;

  struct Piece {
    ConvexPiece shape;
    Interval heights;
    Vector2 centre;  // centre and radius of a disc that contains the piece
    double radius = 0;
    model::CollisionFilter filter{};
  };
  std::vector<Piece> pieces;  // empty if the model collides with nothing
  Interval heights;           // height interval of all of them
  double radius = 0;          // about the model's origin
};

// `tilt` turns the model's frame into one whose z axis is up (normally the identity).
Footprint MakeFootprint(const model::Model& model, const geometry::Quaternion& tilt);

// The height of an edge that the model can drive over. Anything lower than this above its lowest
// point counts as ground. It is half a wheel's radius, between 1 and 5 cm, and at most half the
// model's height.
double ClimbHeight(const model::Model& model, const Footprint& footprint);

}  // namespace gsv::dynamics
